#pragma once

#include <string>
#include <string_view>

#include "peritherm/base/error.hpp"
#include "peritherm/simulation/read.hpp"

namespace peritherm {

/// A case without fault that uses most kinds of options; its lines are counted by tests.
inline constexpr std::string_view valid_case = R"toml(format = 1
title = "Two materials and a crack"
[body]
origin = ["-1 cm", "-1 cm"]
size = ["2 cm", "2 cm"]
cells = [20, 20]
points = "boundary"
material = "plate"
[[body.region]]
material = "fibre"
shape = { type = "box", from = ["-4 mm", "-1 cm"], to = ["-2 mm", "1 cm"] }
[materials.plate]
conductivity = "1.14 W/(cm K)"
density = "1 kg/cm^3"
specific_heat = "1 J/(kg K)"
[materials.fibre]
conductivity = 2
density = 3
specific_heat = 4
[nonlocality]
horizon = "3.5 mm"
kernel = { type = "linear", exponent = 2 }
[initial]
temperature = "60*(x < 0.05)"
[[source]]
value = 1000
[[boundary]]
face = "y_max"
type = "temperature"
value = "100 °C"
[[boundary]]
face = "x_min"
type = "convection"
coefficient = "5 W/(m^2 K)"
ambient = "20 °C"
[[crack]]
points = [["-5 mm", "-4.96 mm"], ["5 mm", "5.04 mm"]]
tip_speed = "2 mm/s"
[numerics]
backend = "auto"
[time]
end = "7.5 s"
integrator = "rkl2"
[[output]]
type = "probe"
name = "centre"
at = [0, 0.001]
every = "0.1 s"
[[output]]
type = "picture"
times = ["1 s", "3 s"]
)toml";

/// The valid case with a piece of its text replaced.
inline std::string changed(std::string_view piece, std::string_view replacement) {
  std::string text(valid_case);
  const auto place = text.find(piece);
  if (place == std::string::npos) throw std::logic_error("not in the valid case: " + std::string(piece));
  return text.replace(place, piece.size(), replacement);
}

/// Everything that is wrong with a case; empty if it can be read.
inline std::vector<Issue> issues_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_case(text, "case.toml", overrides);
  } catch (const Error& error) {
    return error.issues();
  }
  return {};
}

}  // namespace peritherm
