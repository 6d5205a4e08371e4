# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DROOT=.. -DBUILD=.. -DOUT=.. -P check.cmake: installs the library into an empty folder, looks at what is there,
# builds the example of the handbook against it, and runs it.
cmake_minimum_required(VERSION 3.25)
include(${ROOT}/tests/tools/run.cmake)

file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
foreach(component library development)
    run(${CMAKE_COMMAND} --install ${BUILD} --component ${component} --prefix ${OUT}/prefix)
endforeach()

# What is not public is not installed, and every header of the list includes nothing else.
file(GLOB_RECURSE headers RELATIVE ${OUT}/prefix/include ${OUT}/prefix/include/*)
list(TRANSFORM headers REPLACE "^extremal-[0-9.]+/" "")
list(SORT headers)
set(public engine/core/algebra/jet.hpp engine/core/problem.hpp engine/core/value.hpp)
foreach(name answers api catalogue extremal figure own run scene study)
    list(APPEND public extremal/${name}.hpp)
endforeach()
if(NOT headers STREQUAL public)
    message(FATAL_ERROR "installed: ${headers}\npublic: ${public}")
endif()

# No symbol of the engine or of the libraries in it is visible: two versions of them can be in one program.
file(GLOB library ${OUT}/prefix/lib/*.so ${OUT}/prefix/lib/*/*.so)
find_program(NM nm)
if(NM)
    run(${NM} -DC --defined-only ${library})
    string(REGEX MATCHALL "[^\n]+ [TDB] [^\n]+" symbols "${said}")
    list(LENGTH symbols count)
    if(count LESS 30)
        message(FATAL_ERROR "the library shows ${count} symbols only")
    endif()
    foreach(symbol ${symbols})
        # Besides its own: values and errors, which its headers hand out.
        if(NOT symbol MATCHES "extremal::api::" AND NOT symbol MATCHES "extremal::(Value|InvalidScene)(::|$)")
            message(FATAL_ERROR "not public, but visible: ${symbol}")
        endif()
    endforeach()
endif()

# The handbook shows the example as it is here.
file(READ ${ROOT}/tests/library/example.cpp example)
string(REGEX REPLACE "^// SPDX[^\n]*\n" "" example "${example}")
file(READ ${ROOT}/resources/handbook/library.md page)
string(FIND "${page}" "${example}" place)
if(place EQUAL -1)
    message(FATAL_ERROR "resources/handbook/library.md does not show tests/library/example.cpp")
endif()

run(${CMAKE_COMMAND} -S ${ROOT}/tests/library -B ${OUT}/build -G Ninja -DCMAKE_PREFIX_PATH=${OUT}/prefix
    -DCMAKE_BUILD_TYPE=Debug)
run(${CMAKE_COMMAND} --build ${OUT}/build)
run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${OUT}/none ${OUT}/build/example)
# Measured: 1.4e-6 and 5.1e-5 at the end.
if(NOT said MATCHES "galerkin-gauss-2: energy error (-?[0-9.e-]+)\nrk4: energy error (-?[0-9.e-]+)")
    message(FATAL_ERROR "the example says: ${said}")
endif()
if(CMAKE_MATCH_1 GREATER 1e-4 OR CMAKE_MATCH_1 LESS -1e-4)
    message(FATAL_ERROR "the example says: ${said}")
endif()
file(READ ${OUT}/energy.svg picture)
if(NOT picture MATCHES "^<svg.*<path.*</svg>")
    message(FATAL_ERROR "energy.svg: ${picture}")
endif()

# Another minor version is another interface.
file(WRITE ${OUT}/newer/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(newer CXX)\nfind_package(Extremal 0.3 REQUIRED)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${OUT}/newer -B ${OUT}/newer/build -DCMAKE_PREFIX_PATH=${OUT}/prefix
    RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE error)
if(status EQUAL 0 OR NOT error MATCHES "0\\.2")
    message(FATAL_ERROR "version 0.2 was found: ${error}")
endif()
message(STATUS "${said}")
