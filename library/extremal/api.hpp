// SPDX-License-Identifier: GPL-3.0-or-later
/// What every header of the library needs. The headers of this folder are the whole public interface; they
/// include the standard library, and three headers of the engine that do so as well: engine/core/value.hpp
/// (JSON-like trees), problem.hpp (what is wrong with a scene) and jet.hpp (numbers with derivatives).
///
/// Versions follow semver.org: while the major version is 0, a new minor version may change the interface.
/// Objects of the library are handles to immutable data: cheap to copy, and safe to share between threads.
/// Unless it is said otherwise, a function throws extremal::InvalidScene (every error found, each with its
/// JSON pointer and a remedy) for input that cannot be used, and reports numerical trouble in its result.
#pragma once

#define EXTREMAL_API __attribute__((visibility("default")))

namespace extremal::api {

/// "0.2.0": of the library that runs, not of the headers.
EXTREMAL_API const char* version();

}  // namespace extremal::api
