// SPDX-License-Identifier: GPL-3.0-or-later
/// No exception of a library leaves the engine: each becomes a finding with its place.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "engine/core/problem.hpp"

namespace extremal {

/// Calls work(). What it throws besides InvalidScene becomes an InvalidScene at this place.
template <class Work>
decltype(auto) contained(const std::string& pointer, Work&& work) {
    try {
        return work();
    } catch (const InvalidScene&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw InvalidScene(pointer, "needs more memory than there is", "fewer unknowns, or fewer rows");
    } catch (const std::exception& e) {
        throw InvalidScene(pointer, std::string("cannot be computed: ") + e.what(),
                           "parameters and initial data of ordinary size");
    }
}

}  // namespace extremal
