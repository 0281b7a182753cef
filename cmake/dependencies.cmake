# Libraries that the library and the program need; Debian's packages are named in tools/install_dependencies.sh.
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(PkgConfig REQUIRED)
find_package(ZLIB REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(muparser REQUIRED)
find_package(CLI11 REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)

# toml++ is compiled once, in simulation/toml_implementation.cpp: seven seconds less for every other file that reads it.
find_path(TOMLPLUSPLUS_INCLUDE_DIR toml++/toml.h REQUIRED)
add_library(peritherm_toml INTERFACE)
target_include_directories(peritherm_toml SYSTEM INTERFACE ${TOMLPLUSPLUS_INCLUDE_DIR})
target_compile_definitions(peritherm_toml INTERFACE TOML_HEADER_ONLY=0 TOML_ENABLE_FORMATTERS=0)
