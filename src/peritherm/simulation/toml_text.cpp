#include "peritherm/simulation/toml_text.hpp"

#include <algorithm>

namespace peritherm {
namespace {

bool is_bare(char letter) {
  return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || (letter >= '0' && letter <= '9') ||
         letter == '_' || letter == '-';
}

std::string escaped(unsigned char letter) {
  constexpr std::string_view digits = "0123456789abcdef";
  return std::string("\\u00") + digits[letter / 16] + digits[letter % 16];
}

std::string table_of(const TomlEntries& entries) {
  std::string text;
  for (const auto& [key, value] : entries) text += (text.empty() ? " " : ", ") + key + " = " + value;
  return text.empty() ? "{}" : "{" + text + " }";
}

std::string list_of(const ValueKind& kind, const void* list) {
  std::vector<std::string> entries;
  for (std::size_t i = 0; i < kind.count(list); ++i) entries.push_back(toml_value(*kind.inner, kind.part(list, i)));
  return "[" + join(entries) + "]";
}

std::string profile_text(const Profile& profile) {
  return profile.is_number() ? shortest(std::get<double>(profile.value))
                             : toml_string(std::get<std::string>(profile.value));
}

}  // namespace

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
  return bare ? std::string(key) : toml_string(key);
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    const auto code = static_cast<unsigned char>(letter);
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (code < 0x20 || code == 0x7f) {
      quoted += escaped(code);
    } else {
      quoted += letter;
    }
  }
  return quoted + '"';
}

std::string toml_value(const ValueKind& kind, const void* value) {
  TomlEntries entries;
  switch (kind.form) {
    case ValueForm::number:
      return shortest(*static_cast<const double*>(value));
    case ValueForm::whole_number:
      return std::to_string(*static_cast<const int*>(value));
    case ValueForm::flag:
      return *static_cast<const bool*>(value) ? "true" : "false";
    case ValueForm::text:
      return toml_string(*static_cast<const std::string*>(value));
    case ValueForm::profile:
      return profile_text(*static_cast<const Profile*>(value));
    case ValueForm::word:
      return toml_string(kind.words[kind.chosen(value)]);
    case ValueForm::optional:
      return kind.count(value) == 0 ? std::string{} : toml_value(*kind.inner, kind.part(value, 0));
    case ValueForm::list:
      return list_of(kind, value);
    case ValueForm::choice:
      append_chosen_entries(kind, value, entries);
      return table_of(entries);
    case ValueForm::table:
      append_toml_entries(*kind.structs.front(), value, entries);
      return table_of(entries);
    case ValueForm::named_tables:
      break;  // these have lines of their own
  }
  return {};
}

bool is_left_out(const OptionKind& option, const StructKind& kind, const void* owner) {
  const ValueForm form = option.value->form;
  if (form != ValueForm::optional && form != ValueForm::list) return false;
  const bool empty = option.value->count(value_in(owner, option)) == 0;
  if (form == ValueForm::optional) return empty;
  return !option.required && empty && option.value->count(value_in(kind.defaults(), option)) == 0;
}

void append_toml_entries(const StructKind& kind, const void* owner, TomlEntries& entries) {
  for (const OptionKind& option : kind.options) {
    const void* const value = value_in(owner, option);
    if (option.is_choice_beside()) {
      append_chosen_entries(*option.value, value, entries);
    } else if (!is_left_out(option, kind, owner)) {
      entries.emplace_back(option.key, toml_value(*option.value, value));
    }
  }
}

void append_chosen_entries(const ValueKind& choice, const void* value, TomlEntries& entries) {
  const std::size_t chosen = choice.chosen(value);
  entries.emplace_back("type", toml_string(choice.words[chosen]));
  append_toml_entries(*choice.structs[chosen], choice.part(value, chosen), entries);
}

}  // namespace peritherm
