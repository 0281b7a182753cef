#define TOML_IMPLEMENTATION
#include "peritherm/simulation/toml.hpp"
