# The room driver and the program sherd. A kernel unit is what the element loop is compiled for: a degree and a dimension
# of the space; split with laws, degradation, crack density, irreversibility and integrator are chosen at run time.
set(SHERD_KERNELS default CACHE STRING "Kernels of the program sherd: none, default (degrees 2 and 3), all (2 to 4)")
set_property(CACHE SHERD_KERNELS PROPERTY STRINGS none default all)
set(most_kernels 45)
if(SHERD_KERNELS STREQUAL "all")
  set(degrees 2 3 4)
elseif(SHERD_KERNELS STREQUAL "default")
  set(degrees 2 3)
elseif(SHERD_KERNELS STREQUAL "none")
  set(degrees)
else()
  message(FATAL_ERROR "SHERD_KERNELS = ${SHERD_KERNELS}, expected none, default or all")
endif()

set(kernels)
set(sources)
set(declarations)
set(entries)
foreach(spacedim 2 3)
  foreach(degree IN LISTS degrees)
    list(APPEND kernels ${degree}/${spacedim})
    foreach(unit assembler solver run)
      set(source ${CMAKE_CURRENT_BINARY_DIR}/driver/${unit}_${degree}_${spacedim}.cc)
      configure_file(${CMAKE_CURRENT_SOURCE_DIR}/src/driver/kernels/${unit}.cc.in ${source} @ONLY)
      list(APPEND sources ${source})
    endforeach()
    string(APPEND declarations
           "extern template void run_case<${degree}, ${spacedim}>(const Environment &, const Case &)\;\n")
    string(APPEND entries "{${degree}, ${spacedim}, run_case<${degree}, ${spacedim}>}, ")
  endforeach()
endforeach()
list(LENGTH kernels n_kernels)
if(n_kernels GREATER most_kernels)
  message(FATAL_ERROR "${n_kernels} kernels for the program sherd, at most ${most_kernels} are built")
endif()
message(STATUS "Program sherd: ${n_kernels} kernels (degree/dimension: ${kernels}), SHERD_KERNELS=${SHERD_KERNELS}")
configure_file(${CMAKE_CURRENT_SOURCE_DIR}/src/driver/kernels/kernels.cc.in ${CMAKE_CURRENT_BINARY_DIR}/driver/kernels.cc
               @ONLY)

sherd_room(driver ROOMS base spline geometry kinematics material fracture space forms algebra state assembly time solve
                        output adapt)
target_sources(sherd_driver PRIVATE ${sources} ${CMAKE_CURRENT_BINARY_DIR}/driver/kernels.cc)

add_executable(sherd_program src/driver/program/sherd.cc)
set_target_properties(sherd_program PROPERTIES OUTPUT_NAME sherd
                                               RUNTIME_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/bin)
target_link_libraries(sherd_program PRIVATE sherd_driver)
target_compile_options(sherd_program PRIVATE ${SHERD_WARNINGS})
