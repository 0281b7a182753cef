#pragma once

#include <string_view>

namespace peritherm {

/// A plate with every kind of load, a crack and a part that is cut away; small, so that tests are quick.
inline constexpr std::string_view reduced_plate = R"toml(format = 1
title = "Small plate"
[body]
size = [1, 1]
cells = [12, 12]
material = "unit"
[[body.region]]
material = "void"
shape = { type = "box", from = [0.7, 0.7], to = [0.9, 0.9] }
[materials.unit]
conductivity = 1
density = 1
specific_heat = 1
[nonlocality]
horizon_ratio = 3
kernel = "constant"
[initial]
temperature = 20
[[boundary]]
face = "y_max"
type = "temperature"
value = "100 + 40*x*sin(9*t)"
[[boundary]]
face = "x_min"
type = "flux"
value = 30
[[boundary]]
face = "y_min"
type = "convection"
coefficient = 5
ambient = 20
[[source]]
value = 100
where = { type = "ball", centre = [0.3, 0.3], radius = 0.15 }
[[crack]]
points = [[0.2, 0.5], [0.6, 0.5]]
[numerics]
threads = 1
[reduction]
type = "rational_krylov"
tolerance = 1e-7
[time]
end = 0.5
[[output]]
type = "probe"
name = "beside the hole"
at = [0.69, 0.72]
times = [0.01, 0.1, 0.5]
[[output]]
type = "energy"
times = [0, 0.1, 0.5]
)toml";

}  // namespace peritherm
