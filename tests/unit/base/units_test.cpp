#include "peritherm/base/units.hpp"

#include <gtest/gtest.h>

#include <string>

#include "peritherm/base/error.hpp"
#include "peritherm/base/text.hpp"

namespace peritherm {
namespace {

std::string failure(std::string_view text, std::string_view unit) {
  try {
    parse_quantity(text, unit);
  } catch (const Error& error) {
    return error.what();
  }
  return "no failure";
}

struct Conversion {
  std::string_view text;
  std::string_view unit;
  double value;
};

TEST(Units, quantities_become_the_nearest_number_in_si_units) {
  const Conversion conversions[] = {
      {"3 mm", "m", 0.003},
      {"-4.96 mm", "m", -0.00496},
      {"1.5e1 cm", "m", 0.15},
      {"1.14 W/(cm K)", "W/(m K)", 114.0},
      {"1 kg/cm^3", "kg/m^3", 1e6},
      {"7.9 g/cm³", "kg/m^3", 7900.0},
      {"1 J/(kg K)", "J/(kg K)", 1.0},
      {"16 W m^-1 K^-1", "W/(m K)", 16.0},
      {"16 W·m⁻¹·K⁻¹", "W/(m K)", 16.0},
      {"2 W/(m °C)", "W/(m K)", 2.0},
      {"0.5 s", "s", 0.5},
      {"10 min", "s", 600.0},
      {"2 h", "s", 7200.0},
      {"1 day", "s", 86400.0},
      {"2 mm/s", "m/s", 0.002},
      {"5 kW/m^2", "W/m^2", 5000.0},
      {"5 kW m⁻²", "W/m^2", 5000.0},
      {"7 µm", "m", 7e-6},
      {"7 μm", "m", 7e-6},
      {"7 um", "m", 7e-6},
      {"3mm", "m", 0.003},
      {" +3 mm ", "m", 0.003},
      {"12", "m", 12.0},
      {"2 MPa/(K s)*s*m^2", "J/(m K)", 2e6},
      {"4", "", 4.0},
  };
  for (const Conversion& c : conversions) EXPECT_EQ(parse_quantity(c.text, c.unit).value, c.value) << c.text;
}

TEST(Units, temperatures_are_not_converted_and_keep_their_scale) {
  EXPECT_EQ(parse_quantity("20 degC", "K").value, 20.0);
  EXPECT_EQ(parse_quantity("20 °C", "K").scale, TemperatureScale::celsius);
  EXPECT_EQ(parse_quantity("300 K", "K").value, 300.0);
  EXPECT_EQ(parse_quantity("300 K", "K").scale, TemperatureScale::kelvin);
  EXPECT_EQ(parse_quantity("300", "K").scale, TemperatureScale::none);
  EXPECT_EQ(parse_quantity("900 K", absolute_temperature).value, 900.0);
  EXPECT_EQ(parse_quantity("900 K", absolute_temperature).scale, TemperatureScale::none);
  EXPECT_THROW(parse_quantity("900 °C", absolute_temperature), Error);
  EXPECT_EQ(parse_quantity("5 W/(m K)", "W/(m K)").scale, TemperatureScale::none);
}

TEST(Units, a_unit_of_another_quantity_is_named_with_the_expected_one) {
  EXPECT_EQ(failure("5 mm", "J/(kg K)"), "unit 'mm' does not measure this quantity. Expected a multiple of J/(kg K)");
  EXPECT_NE(failure("5 W/m K", "W/(m K)").find("Expected a multiple of W/(m K)"), std::string::npos);
  EXPECT_NE(failure("5 mm", "").find("Write a plain number"), std::string::npos);
}

TEST(Units, an_unknown_unit_gets_a_hint) {
  EXPECT_EQ(failure("5 mn", "m"), "unknown unit 'mn'. Did you mean 'm'?");
  EXPECT_NE(failure("5 kg/m3", "kg/m^3").find("Write powers with ^"), std::string::npos);
  EXPECT_NE(failure("5 furlongs", "m").find("Known are m, g, s"), std::string::npos);
  EXPECT_NE(failure("5 W/(m K", "W/(m K)").find("does not parse"), std::string::npos);
  EXPECT_NE(failure("5 m^", "m").find("does not parse"), std::string::npos);
  EXPECT_NE(failure("5 m^999999999999", "m").find("does not parse"), std::string::npos);
}

TEST(Units, text_without_a_finite_number_is_refused) {
  EXPECT_EQ(failure("inf", "m"), "must be finite. Got inf");
  EXPECT_EQ(failure("-NaN", "m"), "must be finite. Got -NaN");
  EXPECT_NE(failure("1e999 m", "m").find("does not fit"), std::string::npos);
  EXPECT_NE(failure("1e308 km", "m").find("does not fit"), std::string::npos);
  EXPECT_NE(failure("thick", "m").find("expected a number"), std::string::npos);
  EXPECT_NE(failure("", "m").find("expected a number"), std::string::npos);
}

TEST(Units, deeply_nested_units_are_refused_without_harm) {
  EXPECT_NE(failure("1 " + std::string(100000, '('), "m").find("does not parse"), std::string::npos);
}

TEST(Units, numbers_with_units_are_told_from_expressions) {
  for (const char* text : {"5", "5 mm", "-5e3 K", "20 °C", "5 frogs"}) EXPECT_TRUE(looks_like_quantity(text)) << text;
  for (const char* text : {"5*x", "x", "60*(x < 0.05)", "-x", "", "2 + 3"}) {
    EXPECT_FALSE(looks_like_quantity(text)) << text;
  }
}

TEST(Text, the_nearest_word_has_the_fewest_typing_errors) {
  const std::vector<std::string> words{"horizon", "horizon_ratio", "kernel"};
  EXPECT_EQ(nearest_word("horzon", words), "horizon");
  EXPECT_EQ(nearest_word("horizno", words), "horizon");
  EXPECT_EQ(nearest_word("temperature", words), "");
}

TEST(Text, shortest_numbers_read_back_alike) {
  for (const double number : {0.1, 1.0 / 3.0, 1e-300, 123456789.0}) EXPECT_EQ(std::stod(shortest(number)), number);
  EXPECT_EQ(shortest(0.1), "0.1");
}

}  // namespace
}  // namespace peritherm
