# SPDX-License-Identifier: BSD-3-Clause
# What is installed beside program, plugins and SDK, and the Debian package that CPack makes of all of it. Documentation
# keeps the places that it has in the source tree, so that its links hold.
set(doc share/doc/breccia)
install(FILES LICENSE DESTINATION ${doc} RENAME copyright)
install(FILES README.md ARCHITECTURE.md CONTRIBUTING.md CITATION.cff DESTINATION ${doc})
install(DIRECTORY docs DESTINATION ${doc} PATTERN validation EXCLUDE)
file(GLOB reports CONFIGURE_DEPENDS docs/validation/*.md docs/validation/*.json)  # their pictures are as large as all else together
install(FILES ${reports} DESTINATION ${doc}/docs/validation)
install(DIRECTORY plugins DESTINATION ${doc} FILES_MATCHING PATTERN README.md)
install(DIRECTORY workflows DESTINATION share/breccia)
# Where Debian's Python looks; below another prefix PYTHONPATH has to name it.
install(DIRECTORY python/breccia DESTINATION lib/python3/dist-packages FILES_MATCHING PATTERN "*.py" PATTERN py.typed
  PATTERN __pycache__ EXCLUDE)

set(made ${PROJECT_BINARY_DIR}/texts)
file(MAKE_DIRECTORY ${made})
add_custom_command(OUTPUT ${made}/changelog.gz COMMAND gzip -9n < ${PROJECT_SOURCE_DIR}/CHANGELOG.md > ${made}/changelog.gz
  DEPENDS CHANGELOG.md VERBATIM)
add_custom_target(breccia_changelog ALL DEPENDS ${made}/changelog.gz)
install(FILES ${made}/changelog.gz DESTINATION ${doc})

# Links between the two: documentation names workflows, workflows name the schema for editors.
file(CREATE_LINK ../../breccia/workflows ${made}/workflows SYMBOLIC)
file(CREATE_LINK ../doc/breccia/docs ${made}/docs SYMBOLIC)
install(FILES ${made}/workflows DESTINATION ${doc})
install(FILES ${made}/docs DESTINATION share/breccia)

set(BRECCIA_PACKAGE_MAINTAINER "the Breccia authors" CACHE STRING "Who answers for the package: NAME <ADDRESS>")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME breccia)
set(CPACK_PACKAGE_VENDOR "the Breccia authors")
set(CPACK_PACKAGE_CONTACT "${BRECCIA_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "bonded-particle mechanics of rock and concrete")
set(CPACK_PACKAGE_DESCRIPTION
"Packs spheres or discs, bonds them, loads the specimen to failure and
measures stress and strain from the particles; leaves curves, VTK files and
pictures. One YAML file says what is done. Packings, contact laws, tests,
measurements, files and pictures are plugins.
.
With headers and CMake package for plugins of one's own.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
  WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # of the plugins, too, and of the library for checkpoints
# One package: program and SDK must agree to the last digit of the SDK's hash, and `apt install` is to be all that the
# author of a law needs. The SDK's headers include those of Eigen and JSON; the compiler is recommended, which apt
# installs unless told otherwise, so that machines that only run need none.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libeigen3-dev, nlohmann-json3-dev, fonts-dejavu-core")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++ | clang, cmake (>= 3.25), make | ninja-build, python3, python3-numpy, python3-vtk9, python3-yaml")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, paraview, python3-pandas, snakemake, bash-completion")
include(CPack)
