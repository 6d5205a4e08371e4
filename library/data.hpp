// SPDX-License-Identifier: GPL-3.0-or-later
/// What the handles of the library stand for. Not installed.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/run/comparison.hpp"
#include "engine/scene/write/codec.hpp"
#include "extremal/extremal.hpp"

namespace extremal::api {

struct Scene::Data {
    ReadScene read;
};

struct SchemeResult::Data {
    std::shared_ptr<const extremal::SchemeResult> result;
    std::shared_ptr<const extremal::Comparison> comparison;
    std::vector<std::string> columns;
    std::vector<double> x;  ///< of the frames of a field whose nodes do not move
};

struct Comparison::Data {
    std::shared_ptr<const extremal::Comparison> comparison;
};

struct Figure::Data {
    extremal::Figure figure;
};

inline Figure handleOf(extremal::Figure figure) {
    return Figure(std::make_shared<const Figure::Data>(Figure::Data{std::move(figure)}));
}

/// Waits until `waitFor(30 ms)` says that the work is finished, calling progress in between; false: it wanted
/// to stop.
template <class WaitFor, class Fraction>
bool watch(const WaitFor& waitFor, const Fraction& fraction, const Progress& progress) {
    while (!waitFor(std::chrono::milliseconds(30)))
        if (progress && !progress(fraction())) return false;
    return true;
}

}  // namespace extremal::api
