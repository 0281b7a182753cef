#include "peritherm/simulation/write.hpp"

#include "peritherm/simulation/toml_text.hpp"

namespace peritherm {
namespace {

/// Tables of their own lines: structs and maps at the top, and lists of structs anywhere.
template <class Value>
constexpr bool has_own_lines(bool top) {
  if constexpr (is_list_of_tables<Value>) return true;
  return top && (is_table<Value> || is_named_tables<Value>);
}

class Writer {
 public:
  template <Described T>
  void write(const T& owner, const std::string& path) {
    write_values(owner, path.empty());
    for_each_option<T>([this, &owner, &path]<class Value>(const Option<T, Value>& option) {
      if constexpr (has_own_lines<Value>(true)) {
        if (!has_own_lines<Value>(path.empty())) return;
        const std::string key = (path.empty() ? "" : path + '.') + std::string(option.key);
        write_tables(owner.*option.member, key);
      }
    });
  }

  const std::string& text() const { return text_; }

 private:
  /// Options of one line each; they must precede the tables inside.
  template <Described T>
  void write_values(const T& owner, bool top) {
    const auto write_line = [this](std::string_view key, const std::string& value) {
      text_ += std::string(key) + " = " + value + '\n';
    };
    for_each_option<T>([&owner, &write_line, top]<class Value>(const Option<T, Value>& option) {
      if constexpr (is_choice<Value>) {
        if (option.key.empty()) return write_choice(owner.*option.member, write_line);
      }
      if constexpr (!is_list_of_tables<Value> && !is_named_tables<Value>) {
        if (has_own_lines<Value>(top) || is_left_out(option, owner)) return;
        write_line(option.key, toml_value(owner.*option.member));
      }
    });
  }

  template <class Choice, class WriteLine>
  static void write_choice(const Choice& choice, const WriteLine& write_line) {
    std::visit(
        [&write_line]<class Chosen>(const Chosen& chosen) {
          write_line("type", toml_string(Chosen::name));
          for_each_toml_entry(chosen, write_line);
        },
        choice);
  }

  template <Described T>
  void write_tables(const T& table, const std::string& key) {
    text_ += "\n[" + key + "]\n";
    write(table, key);
  }

  template <Described T>
  void write_tables(const std::optional<T>& table, const std::string& key) {
    if (table) write_tables(*table, key);
  }

  template <Described T>
  void write_tables(const std::map<std::string, T>& tables, const std::string& key) {
    if (tables.empty()) text_ += "\n[" + key + "]\n";
    for (const auto& [name, table] : tables) write_tables(table, key + '.' + toml_key(name));
  }

  template <Described T>
  void write_tables(const std::vector<T>& tables, const std::string& key) {
    for (const T& table : tables) {
      text_ += "\n[[" + key + "]]\n";
      write(table, key);
    }
  }

  std::string text_;
};

}  // namespace

std::string write_problem(const Problem& problem) {
  Writer writer;
  writer.write(resolved(problem), "");
  return writer.text();
}

}  // namespace peritherm
