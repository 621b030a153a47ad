# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# The preset "release" hardens, and what BW_HARDEN switches on works: bounds are watched, relocations are read-only, the paths of the
# machine that built stay out.
file(READ ${SOURCE}/CMakePresets.json presets)
string(JSON count LENGTH ${presets} configurePresets)
math(EXPR last "${count} - 1")
set(hardened OFF)
foreach(i RANGE ${last})
  string(JSON name GET ${presets} configurePresets ${i} name)
  if(name STREQUAL "release")
    string(JSON hardened GET ${presets} configurePresets ${i} cacheVariables BW_HARDEN)
  endif()
endforeach()
if(NOT hardened STREQUAL "ON")
  message(FATAL_ERROR "the preset release does not set BW_HARDEN")
endif()

file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE}/tests/structure/hardening -B ${WORK} -DBW_SOURCE=${SOURCE}
                        -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK} OUTPUT_QUIET ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)

execute_process(COMMAND ${WORK}/probe short RESULT_VARIABLE status OUTPUT_VARIABLE text)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the probe does not run: ${status}")
endif()
if(text MATCHES "${SOURCE}")
  message(FATAL_ERROR "the program holds the path of its sources: ${text}")
endif()
execute_process(COMMAND ${WORK}/probe "a text that is longer than sixteen characters"
                RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE text)
if(status EQUAL 0 OR NOT text MATCHES "buffer overflow|stack smashing")
  message(FATAL_ERROR "a text that is too long was copied: ${status} ${text}")
endif()
execute_process(COMMAND ${WORK}/probe RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE text)
if(status EQUAL 0 OR NOT text MATCHES "Assertion")
  message(FATAL_ERROR "an element outside of a vector was read: ${status} ${text}")
endif()
execute_process(COMMAND ${READELF} -W -l -d -s ${WORK}/probe OUTPUT_VARIABLE elf COMMAND_ERROR_IS_FATAL ANY)
foreach(mark GNU_RELRO "BIND_NOW|FLAGS.*NOW" __stack_chk_fail)
  if(NOT elf MATCHES "${mark}")
    message(FATAL_ERROR "the program lacks ${mark}")
  endif()
endforeach()
