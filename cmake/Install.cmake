# Installs the public headers and the one library: find_package(cpslam) gives cpslam::cpslam.
include(CMakePackageConfigHelpers)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/cpslam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS cpslam EXPORT cpslamTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT cpslamTargets NAMESPACE cpslam:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cpslam)
configure_package_config_file(cmake/cpslamConfig.cmake.in ${PROJECT_BINARY_DIR}/cpslamConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cpslam)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cpslamConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cpslamConfig.cmake ${PROJECT_BINARY_DIR}/cpslamConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/cpslam)
