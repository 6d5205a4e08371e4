# SPDX-License-Identifier: GPL-3.0-or-later
# The rules of the source tree, as a function of its root:
#
#     extremal_tree_violations(ROOT OUT)    OUT: a list of "FILE:LINE: WHAT", empty if the tree is sound
#     extremal_licence_violations(ROOT OUT) the same of sources without the line that says their licence
#
# Includes point down the order of the folders; the engine does not use Qt or OpenGL; a file is one idea; a family of
# schemes is named in its own folder only; what a header declares is defined in its folder (definitions.cmake).
include(${CMAKE_CURRENT_LIST_DIR}/definitions.cmake)

# A folder may include itself and every folder before it.
set(levels
    core mesh group quadrature model symmetry space action tableau solve integrator mechanism family baseline trajectory observe view scene run study passport figure inspect
    library ui app)
set(max_lines 500)

# What belongs to one family: the types of its spaces, keys and values that no other family has. Quoted, they occur in
# engine/family/<family> alone, and in tests. Polynomials and splines are tables as well: engine/space may name them,
# and formulas have a function `spline`.
set(families galerkin energy_momentum multiscale lie wave elliptic field asynchronous moving_mesh
    free_knot)
set(names_of_galerkin polynomial spline typed by-coordinate)
set(names_of_energy_momentum moving-time minimise hmin hmax)
set(names_of_multiscale oscillatory oscillatory-product harmonics)
set(names_of_lie lie-polynomial reduced)
set(names_of_wave fourier space-time energy_shift time_basis slabs three-level)
set(names_of_elliptic elliptic-elements)
set(names_of_field tent)
set(names_of_asynchronous asynchronous courant)
set(names_of_free_knot free-knots)
set(names_of_moving_mesh moving-mesh relaxation speed_limit action-error)

set(level 0)
foreach(folder ${levels})
    set(level_of_${folder} ${level})
    math(EXPR level "${level} + 1")
endforeach()

# The folder of the order that a path from the root belongs to; empty for tests, resources and the like.
function(extremal_folder_of path out)
    set(folder "")
    if(path MATCHES "^engine/([^/]+)/")
        set(folder ${CMAKE_MATCH_1})
    elseif(path MATCHES "^(library|ui|app)/")
        set(folder ${CMAKE_MATCH_1})
    endif()
    set(${out} "${folder}" PARENT_SCOPE)
endfunction()

# Includes of one file, as `LINE:NAME` with the brackets of system includes kept: `12:<vector>`.
function(extremal_includes_of file out)
    file(READ ${file} text)
    # Neither semicolons nor brackets may reach CMake's lists.
    string(REGEX REPLACE "[][;\\\\]" " " text "${text}")
    string(REPLACE "\n" ";" lines "${text}")
    set(found "")
    set(number 0)
    foreach(line IN LISTS lines)
        math(EXPR number "${number} + 1")
        if(line MATCHES "^[ \t]*#[ \t]*include[ \t]*(\"[^\"]+\"|<[^>]+>)")
            list(APPEND found "${number}:${CMAKE_MATCH_1}")
        endif()
    endforeach()
    set(${out} "${found}" PARENT_SCOPE)
endfunction()

# Where a file of engine, ui or app names a family to which it does not belong, or includes its headers. Baselines may
# include headers of a family: Crank-Nicolson is Gauss of degree 1 and shares the linear solvers of the wave family.
function(extremal_family_violations root path includes out)
    set(violations "")
    file(READ ${root}/${path} text)
    foreach(family ${families})
        if(path MATCHES "^engine/family/${family}/"
           OR (family STREQUAL "galerkin" AND path MATCHES "^engine/(space/|core/interpolant\\.hpp$)"))
            continue()
        endif()
        list(JOIN names_of_${family} "|" names)
        if(text MATCHES "\"(${names})\"")
            list(APPEND violations "${path}:1: names \"${CMAKE_MATCH_1}\", which belongs to engine/family/${family}")
        endif()
    endforeach()
    foreach(entry ${includes})
        if(NOT path MATCHES "^engine/baseline/" AND entry MATCHES "^([0-9]+):(\"engine/family/([^/]+)/.*)$")
            set(where "${path}:${CMAKE_MATCH_1}")
            set(name "${CMAKE_MATCH_2}")
            if(NOT path MATCHES "^engine/family/${CMAKE_MATCH_3}/")
                list(APPEND violations "${where}: includes ${name} of a family that is not its own")
            endif()
        endif()
    endforeach()
    set(${out} "${violations}" PARENT_SCOPE)
endfunction()

function(extremal_tree_violations root out)
    set(violations "")
    file(GLOB_RECURSE files RELATIVE ${root}
        ${root}/engine/*.hpp ${root}/engine/*.cpp ${root}/library/*.hpp ${root}/library/*.cpp ${root}/ui/*.hpp ${root}/ui/*.cpp
        ${root}/app/*.hpp ${root}/app/*.cpp ${root}/tests/*.hpp ${root}/tests/*.cpp)
    foreach(path ${files})
        extremal_folder_of(${path} folder)
        if(path MATCHES "^engine/" AND (folder STREQUAL "" OR NOT DEFINED level_of_${folder}))
            list(APPEND violations "${path}:1: not in a folder of the engine's order (tests/tree/rules.cmake)")
            continue()
        endif()

        file(READ ${root}/${path} text)
        string(REGEX REPLACE "[^\n]" "" breaks "${text}")
        string(LENGTH "${breaks}" count)
        if(count GREATER max_lines)
            list(APPEND violations "${path}:${count}: more than ${max_lines} lines: split it where the idea splits")
        endif()
        if(path MATCHES "\\.hpp$" AND NOT text MATCHES "\n#pragma once\n")
            list(APPEND violations "${path}:1: a header without #pragma once")
        endif()
        if(path MATCHES "\\.hpp$" AND NOT text MATCHES "^(// SPDX-License-Identifier: [^\n]*\n)?///")
            list(APPEND violations "${path}:1: a header that does not open with what it is (///)")
        endif()
        if(text MATCHES "(TODO|FIXME|XXX)[^A-Za-z]")
            list(APPEND violations "${path}:1: ${CMAKE_MATCH_1}: do it or drop it")
        endif()
        if(NOT path MATCHES "^tests/" AND text MATCHES "[^A-Za-z_](std::sto[dfi]|strtod|atof|sscanf|setlocale) *\\(")
            list(APPEND violations "${path}:1: ${CMAKE_MATCH_1} follows the locale: use std::from_chars")
        endif()

        extremal_includes_of(${root}/${path} includes)
        if(NOT path MATCHES "^tests/")
            extremal_family_violations(${root} ${path} "${includes}" named)
            list(APPEND violations ${named})
            if(path MATCHES "^engine/family/([^/]+)/family.cpp$" AND NOT CMAKE_MATCH_1 IN_LIST families)
                list(APPEND violations "${path}:1: a family whose names are not listed in tests/tree/rules.cmake")
            endif()
        endif()
        foreach(entry ${includes})
            string(REGEX MATCH "^([0-9]+):(.*)$" _ "${entry}")
            set(where "${path}:${CMAKE_MATCH_1}")
            set(name "${CMAKE_MATCH_2}")
            if(path MATCHES "^engine/" AND
                    name MATCHES "^[<\"](Q[A-Za-z]+|Qt[A-Za-z0-9]*/.*|GL/.*|EGL/.*|qcustomplot.*)[>\"]$")
                list(APPEND violations "${where}: ${name} in the engine, which knows no Qt and no OpenGL")
            endif()
            if(folder STREQUAL "" OR NOT name MATCHES "^\"(.*)\"$")
                continue()
            endif()
            set(target ${CMAKE_MATCH_1})
            extremal_folder_of("${target}" other)
            if(other STREQUAL "")
                # ui and app may include files of their own folder; the engine names every file from the root.
                if(path MATCHES "^engine/")
                    list(APPEND violations "${where}: ${name} is not a path from the root")
                endif()
            elseif(NOT DEFINED level_of_${other})
                list(APPEND violations "${where}: ${name} is in no folder of the order")
            elseif(level_of_${other} GREATER level_of_${folder})
                list(APPEND violations "${where}: ${folder} includes ${name}, which is above it")
            endif()
        endforeach()
    endforeach()
    extremal_definition_violations(${root} undefined)
    list(APPEND violations ${undefined})
    set(${out} "${violations}" PARENT_SCOPE)
endfunction()

# Every source begins with its licence, below "#!" where it has that.
function(extremal_licence_violations root out)
    set(violations "")
    set(patterns "")
    foreach(folder engine library ui app tests python package .ci)
        foreach(kind *.cpp *.hpp *.cmake CMakeLists.txt *.py *.pyi *.sh)
            list(APPEND patterns ${root}/${folder}/${kind})
        endforeach()
    endforeach()
    file(GLOB files RELATIVE ${root} ${root}/CMakeLists.txt ${root}/*.sh)
    file(GLOB_RECURSE below RELATIVE ${root} ${patterns})
    foreach(path ${files} ${below})
        file(READ ${root}/${path} text LIMIT 200)
        if(NOT text MATCHES "^(#![^\n]*\n)?(//|#) SPDX-License-Identifier: GPL-3.0-or-later\n")
            list(APPEND violations "${path}:1: no SPDX-License-Identifier: GPL-3.0-or-later")
        endif()
    endforeach()
    set(${out} "${violations}" PARENT_SCOPE)
endfunction()
