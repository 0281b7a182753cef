# Libraries that the library and the program need; Debian's packages are named in tools/install_dependencies.sh.
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(PkgConfig REQUIRED)
find_package(ZLIB REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(muparser REQUIRED)
find_package(CLI11 REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)

# The fft backend. FFTW is under the GPL, and so is a program that is linked to it; without it everything else works.
set(PERITHERM_FFTW AUTO CACHE STRING "Build the fft backend, which needs FFTW: ON, OFF, or AUTO for if it is found")
set_property(CACHE PERITHERM_FFTW PROPERTY STRINGS AUTO ON OFF)
if(PERITHERM_FFTW STREQUAL "AUTO")
  pkg_check_modules(fftw IMPORTED_TARGET fftw3 fftw3f)
elseif(PERITHERM_FFTW)
  pkg_check_modules(fftw REQUIRED IMPORTED_TARGET fftw3 fftw3f)
endif()

# toml++ is compiled once, in simulation/toml_implementation.cpp: seven seconds less for every other file that reads it.
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
add_library(peritherm_toml INTERFACE)
target_include_directories(peritherm_toml SYSTEM INTERFACE ${TOMLPLUSPLUS_INCLUDE_DIR})
target_compile_definitions(peritherm_toml INTERFACE TOML_HEADER_ONLY=0 TOML_ENABLE_FORMATTERS=0)
