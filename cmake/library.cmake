# The library: every *.cpp of every room, without a list to keep.
include(cmake/version.cmake)

set(PERITHERM_ROOMS base geometry physics solutions discretisation operators system integrators reduction two_field output simulation studies papers)
set(sources)
set(headers)
foreach(room IN LISTS PERITHERM_ROOMS)
  file(GLOB room_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/peritherm/${room}/*.cpp)
  file(GLOB room_headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/peritherm/${room}/*.hpp)
  # Unity builds take a room at a time: names inside a room do not collide.
  set_source_files_properties(${room_sources} PROPERTIES UNITY_GROUP ${room})
  list(APPEND sources ${room_sources})
  list(APPEND headers ${room_headers})
endforeach()
# The longest room in two, so that two cores share it: what reads and describes a case, and what runs it.
file(GLOB input_sources ${PROJECT_SOURCE_DIR}/src/peritherm/simulation/*.cpp)
list(FILTER input_sources INCLUDE REGEX "/(check|document|read|schema|write|toml|overrides|locations)[^/]*\\.cpp$")
set_source_files_properties(${input_sources} PROPERTIES UNITY_GROUP simulation_input)

# This one compiles what toml++ merely declares everywhere else.
set_source_files_properties(${PROJECT_SOURCE_DIR}/src/peritherm/simulation/toml_implementation.cpp
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# Instruction sets: x86-64 takes the real files, every other processor their neighbours *_unavailable.cpp.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  list(FILTER sources EXCLUDE REGEX "_kernel_unavailable\\.cpp$")
else()
  list(FILTER sources EXCLUDE REGEX "_(avx2|avx512)\\.cpp$")
endif()

# Optional libraries: their files, or the neighbours that say what is missing and how to get it.
if(TARGET PkgConfig::fftw)
  list(FILTER sources EXCLUDE REGEX "/fourier_sum_unavailable\\.cpp$")
else()
  list(FILTER sources EXCLUDE REGEX "/fourier_sum\\.cpp$")
endif()
if(PERITHERM_HAS_SUNDIALS)
  list(FILTER sources EXCLUDE REGEX "/(sundials|two_field_ida)_unavailable\\.cpp$")
else()
  list(FILTER sources EXCLUDE REGEX "/(sundials_(arkode|cvode|linear_solver|march)|two_field_ida)\\.cpp$")
endif()
list(FILTER headers EXCLUDE REGEX "/sundials_[a-z_]+\\.hpp$")
if(TARGET PkgConfig::hdf5)
  list(FILTER sources EXCLUDE REGEX "/model_file_unavailable\\.cpp$")
else()
  list(FILTER sources EXCLUDE REGEX "/(model_file|hdf5_file)\\.cpp$")
endif()

# Contraction to fused multiply-adds is allowed where it pays and nowhere else, so that all other code gives the same
# bits on every processor.
foreach(source IN LISTS sources)
  set(flags)
  if(source MATCHES "/operators/(stencil|correction)_kernel[^/]*\\.cpp$")
    set(flags -ffp-contract=fast)
  endif()
  # Sums over scattered neighbours: vectors made up entry by entry take three times as long as plain numbers.
  if(source MATCHES "/operators/stencil_kernel[^/]*\\.cpp$")
    # With sanitizers these would take minutes to compile; a test runs them between inaccessible pages instead.
    list(APPEND flags -fno-sanitize=all)
  endif()
  if(source MATCHES "/operators/correction_kernel[^/]*\\.cpp$")
    list(APPEND flags -fno-tree-vectorize -fno-tree-slp-vectorize)
  endif()
  if(source MATCHES "_avx2\\.cpp$")
    list(APPEND flags -mavx2 -mfma)
  elseif(source MATCHES "_avx512\\.cpp$")
    list(APPEND flags -mavx512f -mavx512vl -mavx512dq -mfma -mprefer-vector-width=512)
  endif()
  if(flags)
    set_source_files_properties(${source} PROPERTIES COMPILE_OPTIONS "${flags}")
  endif()
endforeach()

add_library(peritherm ${sources} ${PROJECT_BINARY_DIR}/generated/version.cpp)
add_library(peritherm::peritherm ALIAS peritherm)
target_sources(peritherm PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}/src FILES ${headers})
target_compile_features(peritherm PUBLIC cxx_std_20)
target_compile_options(peritherm PRIVATE -ffp-contract=off)
set_target_properties(peritherm PROPERTIES POSITION_INDEPENDENT_CODE ON UNITY_BUILD ${PERITHERM_UNITY}
                                           UNITY_BUILD_MODE GROUP)
target_link_libraries(
  peritherm
  PRIVATE $<BUILD_INTERFACE:peritherm_options> $<BUILD_INTERFACE:peritherm_toml> OpenMP::OpenMP_CXX ZLIB::ZLIB fmt::fmt
          nlohmann_json::nlohmann_json muparser::muparser PkgConfig::cairo $<BUILD_INTERFACE:Eigen3::Eigen>)
if(TARGET PkgConfig::fftw)
  target_link_libraries(peritherm PRIVATE PkgConfig::fftw)
endif()
if(TARGET PkgConfig::hdf5)
  target_link_libraries(peritherm PRIVATE PkgConfig::hdf5)
endif()
if(PERITHERM_HAS_SUNDIALS)
  target_link_libraries(peritherm PRIVATE $<BUILD_INTERFACE:peritherm_sundials>)
endif()
