#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "peritherm/physics/profile.hpp"
#include "peritherm/simulation/option_kinds.hpp"

namespace peritherm {

struct StructKind;

/// What form a value of a case file has.
enum class ValueForm : std::uint8_t {
  number,
  whole_number,
  flag,
  text,
  profile,
  word,      ///< one of an enumeration
  optional,  ///< a value, or nothing
  list,
  named_tables,
  choice,  ///< one of several described structs
  table    ///< a described struct
};

/// How to look at a value and how to fill it without knowing its type, so that what reads, writes and describes cases
/// is compiled once and not once per option. Parts count from 0: what an optional holds, the entries of a list or of
/// named tables, the chosen struct of a choice.
struct ValueKind {
  ValueForm form{};
  const ValueKind* inner = nullptr;             ///< of what an optional, a list or named tables hold
  std::vector<std::string> names = {};          ///< of a word's values or a choice's structs
  std::vector<const StructKind*> structs = {};  ///< of a choice; of a table its own

  std::size_t (*count)(const void* value) = nullptr;   ///< of the parts of an optional, a list or named tables
  std::size_t (*chosen)(const void* value) = nullptr;  ///< place in names
  const void* (*part)(const void* value, std::size_t number) = nullptr;
  const std::string& (*name_of_part)(const void* value, std::size_t number) = nullptr;  ///< of named tables
  /// Fills an optional, chooses a name, or sets the length of a list; gives the new part of an optional or a choice.
  void* (*make)(void* value, std::size_t number) = nullptr;
  void* (*make_named)(void* value, const std::string& name) = nullptr;  ///< a part of named tables

  /// A part to be filled.
  void* entry(void* value, std::size_t number) const { return const_cast<void*>(part(value, number)); }
};

/// One option of a described struct, as Option has it.
struct OptionKind {
  std::string_view key, unit;
  Check check;
  std::string_view help;
  bool required;
  const ValueKind* value;
  const void* option;  ///< what member needs
  void* (*member)(void* owner, const void* option);
  bool is_choice_beside() const { return key.empty() && value->form == ValueForm::choice; }
};

struct StructKind {
  std::vector<OptionKind> options;
  const void* defaults;         ///< a default value
  std::string_view name, help;  ///< of an alternative
  bool has_type = false;        ///< does it hold a flattened choice, so that its table has a `type`?
};

/// The option's value inside its owner.
inline void* value_in(void* owner, const OptionKind& option) { return option.member(owner, option.option); }
/// The owner is not touched.
inline const void* value_in(const void* owner, const OptionKind& option) {
  return option.member(const_cast<void*>(owner), option.option);
}

template <Described T>
const StructKind& struct_kind();
template <class Value>
const ValueKind& value_kind();

template <NamedEnum Enum>
ValueKind word_kind() {
  constexpr auto chosen = [](const void* value) {
    std::size_t number = 0;
    while (EnumNames<Enum>::values[number].first != *static_cast<const Enum*>(value)) ++number;
    return number;
  };
  constexpr auto make = [](void* value, std::size_t number) -> void* {
    *static_cast<Enum*>(value) = EnumNames<Enum>::values[number].first;
    return nullptr;
  };
  return {.form = ValueForm::word, .names = names_of_values<Enum>(), .chosen = chosen, .make = make};
}

template <class Optional>
ValueKind optional_kind() {
  constexpr auto count = [](const void* value) {
    return static_cast<std::size_t>(static_cast<const Optional*>(value)->has_value());
  };
  constexpr auto part = [](const void* value, std::size_t) -> const void* {
    return &**static_cast<const Optional*>(value);
  };
  constexpr auto make = [](void* value, std::size_t) -> void* { return &static_cast<Optional*>(value)->emplace(); };
  return {.form = ValueForm::optional,
          .inner = &value_kind<typename Optional::value_type>(),
          .count = count,
          .part = part,
          .make = make};
}

template <class List>
ValueKind list_kind() {
  constexpr auto count = [](const void* value) { return static_cast<const List*>(value)->size(); };
  constexpr auto part = [](const void* value, std::size_t number) -> const void* {
    return &(*static_cast<const List*>(value))[number];
  };
  constexpr auto make = [](void* value, std::size_t length) -> void* {
    *static_cast<List*>(value) = List(length);
    return nullptr;
  };
  return {.form = ValueForm::list,
          .inner = &value_kind<typename List::value_type>(),
          .count = count,
          .part = part,
          .make = make};
}

template <class Map>
ValueKind named_tables_kind() {
  constexpr auto count = [](const void* value) { return static_cast<const Map*>(value)->size(); };
  constexpr auto part = [](const void* value, std::size_t number) -> const void* {
    return &std::next(static_cast<const Map*>(value)->begin(), static_cast<std::ptrdiff_t>(number))->second;
  };
  constexpr auto name = [](const void* value, std::size_t number) -> const std::string& {
    return std::next(static_cast<const Map*>(value)->begin(), static_cast<std::ptrdiff_t>(number))->first;
  };
  constexpr auto make = [](void* value, const std::string& key) -> void* { return &(*static_cast<Map*>(value))[key]; };
  return {.form = ValueForm::named_tables,
          .inner = &value_kind<typename Map::mapped_type>(),
          .count = count,
          .part = part,
          .name_of_part = name,
          .make_named = make};
}

template <class Choice>
struct ChoiceKind;

template <Alternative... Alternatives>
struct ChoiceKind<std::variant<Alternatives...>> {
  using Choice = std::variant<Alternatives...>;
  static std::size_t chosen(const void* value) { return static_cast<const Choice*>(value)->index(); }
  static const void* part(const void* value, std::size_t) {
    return std::visit([](const auto& alternative) -> const void* { return &alternative; },
                      *static_cast<const Choice*>(value));
  }
  template <class Chosen>
  static void* make_one(Choice& choice) {
    return &choice.template emplace<Chosen>();
  }
  static void* make(void* value, std::size_t number) {
    static constexpr void* (*makers[])(Choice&) = {&make_one<Alternatives>...};
    return makers[number](*static_cast<Choice*>(value));
  }
  static ValueKind kind() {
    return {.form = ValueForm::choice,
            .names = {std::string(Alternatives::name)...},
            .structs = {&struct_kind<Alternatives>()...},
            .chosen = chosen,
            .part = part,
            .make = make};
  }
};

template <class Value>
ValueKind make_value_kind() {
  if constexpr (is_optional<Value>) {
    return optional_kind<Value>();
  } else if constexpr (is_list<Value>) {
    return list_kind<Value>();
  } else if constexpr (is_named_tables<Value>) {
    return named_tables_kind<Value>();
  } else if constexpr (is_choice<Value>) {
    return ChoiceKind<Value>::kind();
  } else if constexpr (Described<Value>) {
    return {.form = ValueForm::table, .structs = {&struct_kind<Value>()}};
  } else if constexpr (NamedEnum<Value>) {
    return word_kind<Value>();
  } else if constexpr (std::is_same_v<Value, Profile>) {
    return {.form = ValueForm::profile};
  } else if constexpr (std::is_same_v<Value, double>) {
    return {.form = ValueForm::number};
  } else if constexpr (std::is_same_v<Value, int>) {
    return {.form = ValueForm::whole_number};
  } else if constexpr (std::is_same_v<Value, bool>) {
    return {.form = ValueForm::flag};
  } else {
    static_assert(std::is_same_v<Value, std::string>, "no form is known of this kind of option");
    return {.form = ValueForm::text};
  }
}

template <class Value>
const ValueKind& value_kind() {
  static const ValueKind kind = make_value_kind<Value>();
  return kind;
}

template <class Owner, class Value>
void* member_of(void* owner, const void* option) {
  return &(static_cast<Owner*>(owner)->*(static_cast<const Option<Owner, Value>*>(option)->member));
}

template <class Owner, class Value>
OptionKind option_kind(const Option<Owner, Value>& option) {
  return {option.key,      option.unit,          option.check, option.help,
          option.required, &value_kind<Value>(), &option,      member_of<Owner, Value>};
}

template <Described T>
const StructKind& struct_kind() {
  static constexpr auto options = T::options();
  static const T defaults{};
  static const StructKind kind = [] {
    StructKind made{
        std::apply([](const auto&... option) { return std::vector<OptionKind>{option_kind(option)...}; }, options),
        &defaults,
        {},
        {},
        peritherm::has_type<T>()};
    if constexpr (Alternative<T>) {
      made.name = T::name;
      made.help = T::help;
    }
    return made;
  }();
  return kind;
}

}  // namespace peritherm
