# cpack -G DEB: folprom, the program, and libfolprom-dev, static libraries and headers.
set(CPACK_PACKAGE_NAME folprom)
set(CPACK_PACKAGE_CONTACT "Seed aa3b47dc maintainers <maintainers@users.noreply.h-seed-aa3b47dc.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_SOURCE_DIR}/debian_layout.cmake)
# Modes must not come from the umask of who builds.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME folprom)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "Encodes scans of any size as one file that holds every level of detail: the
first bytes are already a coarse mesh, the whole file gives back every vertex
and every face. Reads and writes PLY, OBJ, STL and OFF.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libfolprom-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# Nothing that folprom::decode needs; CMake and pkg-config say what of these is missing.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
  "libtbb-dev, libopenvdb-dev, libboost-iostreams-dev, libembree-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
  "Static libraries, headers, CMake and pkg-config files of folprom. The decoder
needs nothing but the C++ standard library; encoding needs oneTBB and OpenVDB,
measuring distances Embree.")
include(CPack)
