# SPDX-License-Identifier: BSD-3-Clause
# breccia_add_plugin(<kind> <name> SOURCES <file>... [LINK <target>...])
#
# One folder, one plugin, one shared library: breccia_<kind>.<name>.so. The program finds it by that name without
# opening it. Links the SDK (headers and the compile options that the step loop needs), never the core.
function(breccia_add_plugin kind name)
  cmake_parse_arguments(PARSE_ARGV 2 P "" "" "SOURCES;LINK")
  set(target breccia_${kind}_${name})
  add_library(${target} MODULE ${P_SOURCES})
  target_link_libraries(${target} PRIVATE Breccia::sdk ${P_LINK})
  if(TARGET breccia_options)
    target_link_libraries(${target} PRIVATE breccia_options)
  endif()
  set(version "${PROJECT_VERSION}")
  if(NOT version)
    set(version "0")
  endif()
  target_compile_definitions(${target} PRIVATE BRECCIA_PLUGIN_VERSION="${version}")
  # nodelete: objects of a plugin may outlive every handle to its library.
  target_link_options(${target} PRIVATE -Wl,-z,nodelete -Wl,-z,defs)
  if(BRECCIA_SANITIZE)
    target_link_options(${target} PRIVATE -Wl,-z,undefs)
  endif()
  set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME "breccia_${kind}.${name}" SUFFIX ".so"
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON UNITY_BUILD OFF)  # each file has small names of its own
  if(TARGET breccia_headers_plugins)
    if("OpenMP::OpenMP_CXX" IN_LIST P_LINK)  # another dialect: headers of its own
      target_precompile_headers(${target} PRIVATE <breccia/contact_law.hpp>)
    else()
      target_precompile_headers(${target} REUSE_FROM breccia_headers_plugins)
    endif()
  endif()
  if(CMAKE_PROJECT_NAME STREQUAL "Breccia")
    set_target_properties(${target} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/breccia)
    install(TARGETS ${target} LIBRARY DESTINATION lib/breccia)
  endif()
endfunction()

# breccia_add_plugin_checks(<kind> <name> [SET <parameter>=<value>...] [TESTS <file.cpp>...])
#
# Tests of a plugin, for `ctest`; after breccia_add_plugin(<kind> <name> ...) and enable_testing():
# - <kind>.<name>.check: `breccia check` of the plugin as it was just built, with the parameters of SET where defaults and
#   examples do not do;
# - <kind>.<name>.<file>: each source of TESTS, an executable that is called with the program, the plugin's file and the
#   folder of the project (`breccia/test_tools/plugin_test.hpp`).
# The program is Breccia::breccia, which find_package(Breccia) finds beside the SDK.
function(breccia_add_plugin_checks kind name)
  cmake_parse_arguments(PARSE_ARGV 2 P "" "" "SET;TESTS")
  set(plugin breccia_${kind}_${name})
  if(P_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "breccia_add_plugin_checks(${kind} ${name}): what is `${P_UNPARSED_ARGUMENTS}`? "
      "It takes SET parameter=value... and TESTS file.cpp...")
  endif()
  if(NOT TARGET ${plugin})
    message(FATAL_ERROR "breccia_add_plugin_checks(${kind} ${name}): say breccia_add_plugin(${kind} ${name} ...) first")
  endif()
  get_target_property(program Breccia::breccia IMPORTED_LOCATION)
  if(program AND NOT EXISTS "${program}")  # its tests fail until it is there
    message(WARNING "The tests of ${kind}/${name} need the program breccia, and there is no ${program}: only Breccia's "
      "SDK is installed here. Install the program beside it, or name it with -DBRECCIA_PROGRAM=...")
  endif()
  set(parameters "")
  foreach(parameter ${P_SET})
    list(APPEND parameters --set "${parameter}")
  endforeach()
  add_test(NAME ${kind}.${name}.check
    COMMAND Breccia::breccia check ${kind}/${name} --plugin $<TARGET_FILE:${plugin}> ${parameters})
  foreach(source ${P_TESTS})
    get_filename_component(test "${source}" NAME_WE)
    set(executable ${plugin}_${test})
    add_executable(${executable} "${source}")
    set_target_properties(${executable} PROPERTIES OUTPUT_NAME ${test})
    target_link_libraries(${executable} PRIVATE Breccia::sdk)
    add_test(NAME ${kind}.${name}.${test}
      COMMAND ${executable} $<TARGET_FILE:Breccia::breccia> $<TARGET_FILE:${plugin}> "${PROJECT_SOURCE_DIR}")
  endforeach()
endfunction()
