# What "cmake --install" gives to other projects: find_package(perilink) and its target
# perilink::perilink. The component "library" is this part alone.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

add_library(perilink_library INTERFACE)
add_library(perilink::perilink ALIAS perilink_library)
target_link_libraries(perilink_library INTERFACE perilink::app)
set_target_properties(perilink_library PROPERTIES EXPORT_NAME perilink)
set_target_properties(perilink_options PROPERTIES EXPORT_NAME options)

get_property(modules GLOBAL PROPERTY PERILINK_MODULES)
set(module_targets)
foreach(module ${modules})
  set_target_properties(perilink_${module} PROPERTIES EXPORT_NAME ${module})
  list(APPEND module_targets perilink_${module})
endforeach()
install(TARGETS perilink_library perilink_options ${module_targets} EXPORT perilink
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/perilink COMPONENT library
        FILES_MATCHING PATTERN "*.hpp" PATTERN "python" EXCLUDE)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/perilink)
install(EXPORT perilink NAMESPACE perilink:: FILE perilink-targets.cmake
        DESTINATION ${package_dir} COMPONENT library)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/perilink-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/perilink-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/perilink-config-version.cmake
        DESTINATION ${package_dir} COMPONENT library)
