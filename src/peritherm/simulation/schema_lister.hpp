#pragma once

#include <string>
#include <vector>

#include "peritherm/simulation/value_kind.hpp"

namespace peritherm {

/// One line of the reference: a section, an option, or an alternative of the option above it.
struct SchemaRow {
  enum class What { section, option, alternative };
  What what;
  int depth = 0;  ///< how deep inside its section
  std::string key;
  std::string kind;
  std::string range;
  std::string standard;  ///< "required" or the default; empty: left out by default
  std::string help;
};

/// Every row of the reference of a file that is read into such a struct. Alternatives that were listed before are not
/// listed again.
std::vector<SchemaRow> list_schema(const StructKind& kind);

template <Described T>
std::vector<SchemaRow> list_schema() {
  return list_schema(struct_kind<T>);
}

enum class SchemaStyle { plain, markdown };

/// The page; the introduction stands below the title, which only Markdown shows.
std::string schema_page(const std::vector<SchemaRow>& rows, const std::string& title, const std::string& introduction,
                        SchemaStyle style);

}  // namespace peritherm
