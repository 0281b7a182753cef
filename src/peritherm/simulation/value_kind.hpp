#pragma once

#include <array>
#include <iterator>
#include <span>
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
/// is compiled once and not once per option. All of it is constant data. Parts count from 0: what an optional holds,
/// the entries of a list or of named tables, the chosen struct of a choice.
struct ValueKind {
  ValueForm form{};
  const ValueKind* inner = nullptr;                 ///< of what an optional, a list or named tables hold
  std::span<const std::string_view> words = {};     ///< of a word's values or a choice's structs
  std::span<const StructKind* const> structs = {};  ///< of a choice; of a table its own

  std::size_t (*count)(const void* value) = nullptr;   ///< of the parts of an optional, a list or named tables
  std::size_t (*chosen)(const void* value) = nullptr;  ///< place in words
  const void* (*part)(const void* value, std::size_t number) = nullptr;
  const std::string& (*name_of_part)(const void* value, std::size_t number) = nullptr;  ///< of named tables
  /// Fills an optional, chooses a word, or sets the length of a list; gives the new part of an optional or a choice.
  void* (*make)(void* value, std::size_t number) = nullptr;
  void* (*make_named)(void* value, const std::string& name) = nullptr;  ///< a part of named tables

  /// A part to be filled.
  void* entry(void* value, std::size_t number) const { return const_cast<void*>(part(value, number)); }
  std::vector<std::string> names() const { return {words.begin(), words.end()}; }
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
  std::span<const OptionKind> options;
  const void* (*defaults)();    ///< a default value
  std::string_view name, help;  ///< of an alternative
  bool has_type;                ///< does it hold a flattened choice, so that its table has a `type`?
};

/// The option's value inside its owner.
inline void* value_in(void* owner, const OptionKind& option) { return option.member(owner, option.option); }
/// The owner is not touched.
inline const void* value_in(const void* owner, const OptionKind& option) {
  return option.member(const_cast<void*>(owner), option.option);
}

/// What makes the kind of a value; specialised for each form below.
template <class Value>
struct KindOf;
template <class Value>
inline constexpr ValueKind value_kind = KindOf<Value>::kind();
template <Described T>
struct StructOf;
template <Described T>
inline constexpr StructKind struct_kind = StructOf<T>::kind();

template <>
struct KindOf<double> {
  static constexpr ValueKind kind() { return {.form = ValueForm::number}; }
};
template <>
struct KindOf<int> {
  static constexpr ValueKind kind() { return {.form = ValueForm::whole_number}; }
};
template <>
struct KindOf<bool> {
  static constexpr ValueKind kind() { return {.form = ValueForm::flag}; }
};
template <>
struct KindOf<std::string> {
  static constexpr ValueKind kind() { return {.form = ValueForm::text}; }
};
template <>
struct KindOf<Profile> {
  static constexpr ValueKind kind() { return {.form = ValueForm::profile}; }
};

template <NamedEnum Enum>
struct KindOf<Enum> {
  static constexpr auto words = [] {
    std::array<std::string_view, EnumNames<Enum>::values.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = EnumNames<Enum>::values[i].second;
    return names;
  }();
  static std::size_t chosen(const void* value) {
    std::size_t number = 0;
    while (EnumNames<Enum>::values[number].first != *static_cast<const Enum*>(value)) ++number;
    return number;
  }
  static void* make(void* value, std::size_t number) {
    *static_cast<Enum*>(value) = EnumNames<Enum>::values[number].first;
    return nullptr;
  }
  static constexpr ValueKind kind() {
    return {.form = ValueForm::word, .words = words, .chosen = chosen, .make = make};
  }
};

template <class Value>
struct KindOf<std::optional<Value>> {
  using Optional = std::optional<Value>;
  static std::size_t count(const void* value) { return static_cast<const Optional*>(value)->has_value() ? 1 : 0; }
  static const void* part(const void* value, std::size_t) { return &**static_cast<const Optional*>(value); }
  static void* make(void* value, std::size_t) { return &static_cast<Optional*>(value)->emplace(); }
  static constexpr ValueKind kind() {
    return {.form = ValueForm::optional, .inner = &value_kind<Value>, .count = count, .part = part, .make = make};
  }
};

template <class Value>
struct KindOf<std::vector<Value>> {
  using List = std::vector<Value>;
  static std::size_t count(const void* value) { return static_cast<const List*>(value)->size(); }
  static const void* part(const void* value, std::size_t number) { return &(*static_cast<const List*>(value))[number]; }
  static void* make(void* value, std::size_t length) {
    List(length).swap(*static_cast<List*>(value));
    return nullptr;
  }
  static constexpr ValueKind kind() {
    return {.form = ValueForm::list, .inner = &value_kind<Value>, .count = count, .part = part, .make = make};
  }
};

template <class Value>
struct KindOf<std::map<std::string, Value>> {
  using Map = std::map<std::string, Value>;
  static auto entry(const void* value, std::size_t number) {
    return std::next(static_cast<const Map*>(value)->begin(), static_cast<std::ptrdiff_t>(number));
  }
  static std::size_t count(const void* value) { return static_cast<const Map*>(value)->size(); }
  static const void* part(const void* value, std::size_t number) { return &entry(value, number)->second; }
  static const std::string& name(const void* value, std::size_t number) { return entry(value, number)->first; }
  static void* make(void* value, const std::string& key) { return &(*static_cast<Map*>(value))[key]; }
  static constexpr ValueKind kind() {
    return {.form = ValueForm::named_tables,
            .inner = &value_kind<Value>,
            .count = count,
            .part = part,
            .name_of_part = name,
            .make_named = make};
  }
};

template <Alternative... Alternatives>
struct KindOf<std::variant<Alternatives...>> {
  using Choice = std::variant<Alternatives...>;
  static constexpr std::array<std::string_view, sizeof...(Alternatives)> words{Alternatives::name...};
  static constexpr std::array<const StructKind*, sizeof...(Alternatives)> structs{&struct_kind<Alternatives>...};
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
  static constexpr ValueKind kind() {
    return {
        .form = ValueForm::choice, .words = words, .structs = structs, .chosen = chosen, .part = part, .make = make};
  }
};

template <Described T>
struct KindOf<T> {
  static constexpr std::array<const StructKind*, 1> structs{&struct_kind<T>};
  static constexpr ValueKind kind() { return {.form = ValueForm::table, .structs = structs}; }
};

template <Described T>
struct StructOf {
  static constexpr auto described = T::options();

  static const void* defaults() {
    static const T value{};
    return &value;
  }
  template <class Value>
  static void* member(void* owner, const void* option) {
    return &(static_cast<T*>(owner)->*(static_cast<const Option<T, Value>*>(option)->member));
  }
  template <class Value>
  static constexpr OptionKind option_kind(const Option<T, Value>& option) {
    return {option.key,      option.unit,        option.check, option.help,
            option.required, &value_kind<Value>, &option,      member<Value>};
  }
  static constexpr auto options = std::apply(
      [](const auto&... option) { return std::array<OptionKind, sizeof...(option)>{option_kind(option)...}; },
      described);

  static constexpr StructKind kind() {
    StructKind made{options, defaults, {}, {}, false};
    for (const OptionKind& option : options) made.has_type = made.has_type || option.key.empty();
    if constexpr (Alternative<T>) {
      made.name = T::name;
      made.help = T::help;
    }
    return made;
  }
};

}  // namespace peritherm
