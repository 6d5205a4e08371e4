# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DROOT=.. -DBUILD=.. -DOUT=.. -P check.cmake: installs the program into an empty folder, runs it there, and validates
# what desktops read, as far as their tools are installed.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/tools/run.cmake)

file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
run(${CMAKE_COMMAND} --install ${BUILD} --component program --prefix ${OUT}/usr)
file(GLOB_RECURSE files RELATIVE ${OUT}/usr ${OUT}/usr/*)
set(expected bin/extremal share/applications/org.extremal.Extremal.desktop share/bash-completion/completions/extremal
    share/doc/extremal/changelog.gz share/doc/extremal/copyright share/extremal/scene.schema.json
    share/fish/vendor_completions.d/extremal.fish share/icons/hicolor/scalable/apps/org.extremal.Extremal.svg
    share/man/man1/extremal.1.gz share/metainfo/org.extremal.Extremal.metainfo.xml share/mime/packages/extremal.xml
    share/zsh/vendor-completions/_extremal)
# Two pictures of every preset, on light and on dark ground.
file(GLOB presets RELATIVE ${ROOT}/presets ${ROOT}/presets/*.json)
list(REMOVE_ITEM presets scene.schema.json)
foreach(preset ${presets})
    string(REGEX REPLACE "\\.json$" "" preset ${preset})
    list(APPEND expected share/extremal/pictures/${preset}-light.png share/extremal/pictures/${preset}-dark.png)
endforeach()
list(SORT files)
list(SORT expected)
if(NOT files STREQUAL expected)
    message(FATAL_ERROR "installed: ${files}\nexpected: ${expected}")
endif()
run(${OUT}/usr/bin/extremal --version)
if(NOT said MATCHES "^extremal [0-9]")
    message(FATAL_ERROR "the installed program says: ${said}")
endif()
# The version of the release notes is that of the program.
string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" version "${said}")
file(READ ${OUT}/usr/share/metainfo/org.extremal.Extremal.metainfo.xml metainfo)
if(NOT metainfo MATCHES "release version=\"${version}\"")
    message(FATAL_ERROR "the metainfo has no release ${version}")
endif()

find_program(APPSTREAM appstreamcli)
if(APPSTREAM)
    run(${APPSTREAM} validate --no-net ${OUT}/usr/share/metainfo/org.extremal.Extremal.metainfo.xml)
endif()
find_program(DESKTOP desktop-file-validate)
if(DESKTOP)
    run(${DESKTOP} ${OUT}/usr/share/applications/org.extremal.Extremal.desktop)
    if(NOT "${said}${error}" STREQUAL "")
        message(FATAL_ERROR "${said}${error}")
    endif()
endif()
# The type of a scene is found by its name; other JSON files stay what they are.
find_program(MIME update-mime-database)
if(MIME)
    run(${MIME} ${OUT}/usr/share/mime)
    file(READ ${OUT}/usr/share/mime/globs2 globs)
    foreach(pattern "*.extremal" "*.extremal.json")
        string(FIND "${globs}" "application/x-extremal-scene+json:${pattern}\n" place)
        if(place EQUAL -1)
            message(FATAL_ERROR "${pattern} is no scene: ${globs}")
        endif()
    endforeach()
    if(globs MATCHES "x-extremal-scene\\+json:\\*\\.json")
        message(FATAL_ERROR "every JSON file is a scene")
    endif()
endif()
