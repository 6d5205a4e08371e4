# SPDX-License-Identifier: GPL-3.0-or-later
# What a header declares is defined in its own folder, as a function of the tree's root:
#
#     extremal_definition_violations(ROOT OUT)    OUT: a list of "FILE:1: WHAT", empty if the tree is sound
#
# A heuristic over formatted sources: what begins a line there is at namespace scope, and what belongs to it is
# indented. Catalogues that CMake generates count to the folder of their header.

# The lines of a file that begin at the margin, each with what is indented below it; without comments, and with "@"
# for ";".
function(extremal_margin_lines file out)
    file(READ ${file} text)
    string(REGEX REPLACE "[][\\\\]" " " text "${text}")
    string(REPLACE ";" "@" text "${text}")
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REPLACE "= {}" "" text "${text}")
    string(REGEX REPLACE "\n[ \t]+" " " text "${text}")
    string(REPLACE "\n" ";" lines "${text}")
    set(${out} "${lines}" PARENT_SCOPE)
endfunction()

function(extremal_definition_violations root out)
    set(violations "")
    # FOLDER/NAME of every function that is defined at the margin, or generated.
    set(defined "/scene/presets//scene/extremeScenes/")
    if(EXISTS ${root}/engine/CMakeLists.txt)
        file(READ ${root}/engine/CMakeLists.txt text)
        if(text MATCHES "extremal_families\\(family\\)")
            string(APPEND text "\nengine/family/family.hpp families)\n")
        endif()
        string(REGEX MATCHALL "engine/[a-z]+/[a-z_/]+\\.hpp +[A-Za-z]+\\)" catalogues "${text}")
        foreach(catalogue ${catalogues})
            string(REGEX MATCH "engine/([a-z]+)/[^ ]+ +([A-Za-z]+)" _ "${catalogue}")
            string(APPEND defined "/${CMAKE_MATCH_1}/${CMAKE_MATCH_2}/")
        endforeach()
    endif()
    file(GLOB_RECURSE files RELATIVE ${root} ${root}/engine/*.hpp ${root}/engine/*.cpp)
    set(declared "")
    foreach(path ${files})
        string(REGEX MATCH "^engine/([^/]+)/" _ "${path}")
        set(folder ${CMAKE_MATCH_1})
        extremal_margin_lines(${root}/${path} lines)
        foreach(line IN LISTS lines)
            if(line MATCHES "^[A-Za-z][^@{=(]*[ &*]([a-z][A-Za-z0-9_]*)\\([^@{]*\\)[^@{]*([@{])")
                set(name ${CMAKE_MATCH_1})
                if(CMAKE_MATCH_2 STREQUAL "{")
                    string(APPEND defined "/${folder}/${name}/")
                elseif(path MATCHES "\\.hpp$" AND
                        NOT line MATCHES "^(using|class|struct|friend|namespace|template|static|enum|extern|public:|private:|protected:)")
                    list(APPEND declared "${path}|${folder}/${name}")
                endif()
            endif()
        endforeach()
    endforeach()
    foreach(each ${declared})
        string(REPLACE "|" ";" each "${each}")
        list(GET each 0 path)
        list(GET each 1 what)
        if(NOT defined MATCHES "/${what}/")
            list(APPEND violations "${path}:1: declares ${what}, which nothing in its folder defines")
        endif()
    endforeach()
    set(${out} "${violations}" PARENT_SCOPE)
endfunction()
