# One library a room: its compiled sources src/<room>/*.cc, linked to the rooms it may include (scripts/check-layers
# holds the same table for the headers). A room without sources is an interface library.
set(SHERD_ROOMS)

function(sherd_room room)
  cmake_parse_arguments(ARG "" "" "ROOMS;PRIVATE" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/${room}/*.cc)
  set(target sherd_${room})
  list(TRANSFORM ARG_ROOMS PREPEND sherd_)
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(${target} PUBLIC ${ARG_ROOMS} PRIVATE ${ARG_PRIVATE})
    target_compile_options(${target} PRIVATE ${SHERD_WARNINGS})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(${target} INTERFACE ${ARG_ROOMS})
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                $<INSTALL_INTERFACE:include>)
  target_link_libraries(${target} ${scope} Eigen3::Eigen MPI::MPI_CXX OpenMP::OpenMP_CXX)
  # Eigen's alignment follows the instruction set, so all that links to the library is compiled alike.
  if(SHERD_NATIVE)
    target_compile_options(${target} ${scope} -march=native)
  endif()
  if(SHERD_SANITIZE)
    target_compile_options(${target} ${scope} -fsanitize=${SHERD_SANITIZE} -fno-omit-frame-pointer
                                              -fno-sanitize-recover=undefined)
    target_link_options(${target} ${scope} -fsanitize=${SHERD_SANITIZE})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${room})
  set(SHERD_ROOMS ${SHERD_ROOMS} ${room} PARENT_SCOPE)
endfunction()

sherd_room(base PRIVATE sherd_trilinos sherd_yaml sherd_muparser)
sherd_room(spline ROOMS base)
sherd_room(geometry ROOMS base spline PRIVATE pugixml::pugixml)
sherd_room(kinematics ROOMS base)
sherd_room(material ROOMS base kinematics)
sherd_room(fracture ROOMS base)
sherd_room(space ROOMS base spline geometry PRIVATE METIS::METIS)
sherd_room(forms ROOMS base spline geometry kinematics material fracture)
# Most of it is headers of Anasazi; its work is done in compiled libraries.
set_source_files_properties(src/algebra/eigen_solver.cc PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
sherd_room(algebra ROOMS base PRIVATE sherd_trilinos MUMPS::DMUMPS METIS::METIS)
sherd_room(state ROOMS base spline geometry fracture space algebra)
sherd_room(assembly ROOMS base spline geometry kinematics material fracture space forms algebra state)
sherd_room(time ROOMS base algebra state)
sherd_room(solve ROOMS base spline geometry kinematics material fracture space forms algebra state assembly time)
# Small products of Eigen at every quadrature point are calls unless inlining is forced: a tenth of the element loop of
# the models in solve/instances.h, and twice the time to compile them.
target_compile_definitions(sherd_solve
                           PRIVATE $<$<CONFIG:Release>:EIGEN_STRONG_INLINE=__attribute__\(\(always_inline\)\)\ inline>)
sherd_room(output ROOMS base spline geometry kinematics material fracture space forms algebra state assembly time
           PRIVATE sherd_hdf5 ZLIB::ZLIB)
# The same intrinsics, seen through Eigen's products of degree 3.
set_source_files_properties(src/output/crack_tracker.cc PROPERTIES COMPILE_OPTIONS -Wno-uninitialized)
sherd_room(adapt ROOMS base spline geometry kinematics material fracture space forms algebra state assembly time solve)
sherd_room(verify ROOMS base kinematics material fracture forms)

add_library(sherd INTERFACE)
add_library(sherd::sherd ALIAS sherd)
foreach(room IN LISTS SHERD_ROOMS)
  target_link_libraries(sherd INTERFACE sherd_${room})
endforeach()
