#include "peritherm/simulation/schema.hpp"

#include <gtest/gtest.h>

#include "peritherm/simulation/option_kinds.hpp"
#include "peritherm/simulation/problem.hpp"

namespace peritherm {
namespace {

template <class Choice>
void expect_alternatives(const std::string& text) {
  for_each_alternative<Choice>([&text]<class Chosen>(const Chosen&) {
    EXPECT_NE(text.find("type = \"" + std::string(Chosen::name) + "\""), std::string::npos) << Chosen::name;
    for_each_option<Chosen>([&text](const auto& option) {
      EXPECT_NE(text.find(option.help), std::string::npos) << Chosen::name << '.' << option.key;
    });
  });
}

TEST(Schema, every_alternative_of_every_list_is_described) {
  for (const std::string& text : {describe_case_file(), describe_case_file_in_markdown()}) {
    expect_alternatives<Shape>(text);
    expect_alternatives<KernelForm>(text);
    expect_alternatives<BoundaryCondition>(text);
    expect_alternatives<TimeStepping>(text);
    expect_alternatives<OutputKind>(text);
  }
}

TEST(Schema, an_option_has_kind_unit_range_default_and_help) {
  const std::string text = describe_case_file();
  EXPECT_NE(text.find("density: number [kg/m^3], must be positive, required\n      density"), std::string::npos)
      << text;
  EXPECT_NE(text.find("scheme: peritherm | bobaru_2010 | bobaru_2012 | mei_2021, default \"peritherm\""),
            std::string::npos);
  EXPECT_NE(text.find("[[body.region]]"), std::string::npos);
  EXPECT_NE(text.find("[materials.NAME]"), std::string::npos);
}

TEST(Schema, rows_of_the_markdown_tables_have_five_cells) {
  const std::string text = describe_case_file_in_markdown();
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    begin = end + 1;
    if (!line.starts_with('|')) continue;
    int bars = 0;
    for (std::size_t i = 0; i < line.size(); ++i) bars += line[i] == '|' && (i == 0 || line[i - 1] != '\\');
    EXPECT_EQ(bars, 6) << line;
  }
}

}  // namespace
}  // namespace peritherm
