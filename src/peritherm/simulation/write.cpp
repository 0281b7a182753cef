#include "peritherm/simulation/write.hpp"

#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {
namespace {

const ValueKind& held_kind(const ValueKind& kind) { return kind.form == ValueForm::optional ? *kind.inner : kind; }

bool is_list_of_structs(const ValueKind& kind) {
  return kind.form == ValueForm::list && kind.inner->form == ValueForm::table;
}

/// Tables of their own lines: structs and maps at the top, and lists of structs anywhere.
bool has_own_lines(const ValueKind& kind, bool top) {
  if (is_list_of_structs(kind)) return true;
  return top && (kind.form == ValueForm::named_tables || held_kind(kind).form == ValueForm::table);
}

class Writer {
 public:
  void write(const StructKind& kind, const void* owner, const std::string& path) {
    const bool top = path.empty();
    write_values(kind, owner, top);
    for (const OptionKind& option : kind.options) {
      if (!has_own_lines(*option.value, top)) continue;
      write_tables(*option.value, value_in(owner, option), (top ? "" : path + '.') + std::string(option.key));
    }
  }

  const std::string& text() const { return text_; }

 private:
  /// Options of one line each; they must precede the tables inside.
  void write_values(const StructKind& kind, const void* owner, bool top) {
    TomlEntries entries;
    for (const OptionKind& option : kind.options) {
      const void* const value = value_in(owner, option);
      if (option.is_choice_beside()) {
        append_chosen_entries(*option.value, value, entries);
      } else if (!has_own_lines(*option.value, top) && option.value->form != ValueForm::named_tables &&
                 !is_left_out(option, kind, owner)) {
        entries.emplace_back(option.key, toml_value(*option.value, value));
      }
    }
    for (const auto& [key, value] : entries) text_ += key + " = " + value + '\n';
  }

  void write_tables(const ValueKind& kind, const void* value, const std::string& key) {
    if (kind.form == ValueForm::table) {
      text_ += "\n[" + key + "]\n";
      return write(*kind.structs.front(), value, key);
    }
    const std::size_t count = kind.count(value);
    if (count == 0 && kind.form == ValueForm::named_tables) text_ += "\n[" + key + "]\n";
    for (std::size_t i = 0; i < count; ++i) {
      const void* const part = kind.part(value, i);
      if (kind.form == ValueForm::list) {
        text_ += "\n[[" + key + "]]\n";
        write(*kind.inner->structs.front(), part, key);
      } else {
        const bool named = kind.form == ValueForm::named_tables;
        write_tables(*kind.inner, part, named ? key + '.' + toml_key(kind.name_of_part(value, i)) : key);
      }
    }
  }

  std::string text_;
};

}  // namespace

std::string write_problem(const Problem& problem) {
  Writer writer;
  const Problem all = resolved(problem);
  writer.write(struct_kind<Problem>, &all, "");
  return writer.text();
}

}  // namespace peritherm
