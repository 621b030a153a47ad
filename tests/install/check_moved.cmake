# SPDX-FileCopyrightText: 2026 The Bladewright authors
# SPDX-License-Identifier: MIT
#
# Installs this build into a prefix, moves the prefix, and does there what a user does first. That nothing is taken from the source tree
# shows in the programs, which do not hold the path of its resources, and in a program without its share, which finds none.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${WORK})
set(ENV{DESTDIR})
set(ENV{BLADEWRIGHT_RESOURCES})
foreach(place CONFIG DATA STATE CACHE)
  set(ENV{XDG_${place}_HOME} ${WORK}/home)
endforeach()
set(moved "${WORK}/moved here")

# run(<what is expected of its output> <command…>)
function(run expected)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0 OR NOT text MATCHES "${expected}")
    message(FATAL_ERROR "${ARGN}: status ${status}, not what was expected: ${text}")
  endif()
endfunction()
function(must_exist)
  foreach(path IN LISTS ARGN)
    if(NOT EXISTS "${path}")
      message(FATAL_ERROR "${path} is missing")
    endif()
  endforeach()
endfunction()

run("" ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(RENAME ${WORK}/prefix "${moved}")
must_exist("${moved}/bin/blade" "${moved}/bin/bladewright" "${moved}/share/applications/bladewright.desktop"
           "${moved}/share/mime/packages/bladewright.xml" "${moved}/share/icons/hicolor/scalable/apps/bladewright.svg"
           "${moved}/share/icons/hicolor/48x48/apps/bladewright.png" "${moved}/share/doc/bladewright/copyright")
foreach(program blade bladewright)
  file(STRINGS "${moved}/bin/${program}" found REGEX "${SOURCE}/resources" LIMIT_COUNT 1)
  if(found)
    message(FATAL_ERROR "${program} holds the path of the sources' resources: ${found}")
  endif()
  run("${VERSION}" "${moved}/bin/${program}" --version)
endforeach()

# A design of an example with its blade, and its results.
set(design ${WORK}/panel.bladewright)
run("" "${moved}/bin/blade" example panel-600x670 --out ${design})
run("" "${moved}/bin/blade" design ${design} --out ${WORK}/results)
must_exist(${WORK}/results/report.json ${WORK}/results/programs)

run("" ${DISPLAY} "${moved}/bin/bladewright" --example torus-patch --screenshot ${WORK}/window.png)
must_exist(${WORK}/window.png)

# The same program alone.
file(COPY "${moved}/bin/blade" DESTINATION ${WORK}/alone/bin)
execute_process(COMMAND ${WORK}/alone/bin/blade example panel-600x670 --out ${WORK}/alone.bladewright
                RESULT_VARIABLE status ERROR_VARIABLE text)
if(status EQUAL 0 OR NOT text MATCHES "install the program whole")
  message(FATAL_ERROR "without its share the program found resources somewhere: ${status} ${text}")
endif()
