include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/sherd)
set(targets sherd)
foreach(room IN LISTS SHERD_ROOMS)
  list(APPEND targets sherd_${room})
endforeach()
install(TARGETS ${targets} EXPORT sherdTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS sherd_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT sherdTargets NAMESPACE sherd:: DESTINATION ${config_dir})
install(DIRECTORY include/sherd DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
configure_package_config_file(src/cmake/sherdConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/sherdConfig.cmake
                              INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/sherdConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/sherdConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/sherdConfigVersion.cmake
              src/cmake/SherdDependencies.cmake src/cmake/FindMETIS.cmake src/cmake/FindMUMPS.cmake
        DESTINATION ${config_dir})
