# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DROOT=<folder of the project> -P check_tree.cmake: fails naming every violation of the tree's rules.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/rules.cmake)
extremal_tree_violations(${ROOT} violations)
foreach(kind licence room handbook)
    cmake_language(CALL extremal_${kind}_violations ${ROOT} found)
    list(APPEND violations ${found})
endforeach()
list(LENGTH violations count)
if(count GREATER 0)
    list(JOIN violations "\n" text)
    message(FATAL_ERROR "${count} violations of the tree's rules:\n${text}")
endif()
