# An overlay port (vcpkg install sinew --overlay-ports=packaging/vcpkg) of the sources that it stands in.
cmake_path(SET SOURCE_PATH NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../..")
vcpkg_add_to_path("${CURRENT_HOST_INSTALLED_DIR}/tools/glslang")
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS -DSINEW_BUILD_APPS=OFF -DSINEW_BUILD_TESTS=OFF -DSINEW_CHECK_KERNELS=OFF
            "-DVULKAN_HEADERS=${CURRENT_INSTALLED_DIR}/include")
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME sinew CONFIG_PATH lib/cmake/sinew)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
