#pragma once

#include <cstddef>

namespace peritherm {

/// Memory that this process may still use [B]: what the machine and the control group leave; 0 if unknown.
std::size_t available_memory();

/// Most memory that this process has held at once [B]; 0 if unknown.
std::size_t peak_memory();

}  // namespace peritherm
