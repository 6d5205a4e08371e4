// SPDX-License-Identifier: GPL-3.0-or-later
/// Maps written by hand: two schemes over six values of k and five steps.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "engine/figure/figure.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal::handmade {

inline Scene mapScene() {
    return readScene(
               std::string(
                   R"({"extremal":1,"model":{"type":"harmonic-oscillator","k":100},"time":{"end":1},"initial":{"q":[1],"p":[0]},
        "schemes":[{"label":"midpoint","step":0.02,"scheme":"midpoint"},{"label":"RK4","step":0.05,"baseline":"rk4"}],
        "observe":["energy"],"views":[{"view":"parameter-map","from":1,"to":1e5,"steps":[0.001,0.1],"cells":[6,5]}]})"))
        .scene;
}

/// 10^-(10 - i - j) at value i and step j; of the midpoint rule beyond i + j = 7 blown up, failed, or not
/// computed. RK4 is a hundred times worse.
inline Comparison mapComparison() {
    Comparison c;
    c.scene = mapScene();
    c.isFinished = true;
    for (std::size_t s = 0; s < 2; ++s) {
        auto result = std::make_shared<SchemeResult>();
        result->spec = c.scene.schemes[s];
        result->style = static_cast<int>(s);
        c.schemes.push_back(result);
        auto map = std::make_shared<ParameterMap>();
        map->scheme = c.scene.schemes[s].label;
        map->style = static_cast<int>(s);
        map->grid = mapGridOf(c.scene, c.scene.views[0]);
        map->problems.resize(6);
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j < 5; ++j) {
                MapCell cell;
                cell.end = s == 1 || i + j < 7 ? MapCell::End::done
                           : j == 4            ? MapCell::End::blownUp
                           : j == 3            ? MapCell::End::failed
                                               : MapCell::End::waiting;
                cell.cause = cell.end == MapCell::End::failed ? Outcome::diverged : Outcome::converged;
                if (cell.isDone()) cell.value = std::pow(10, i + j - 10 + 2 * static_cast<int>(s));
                map->cells.push_back(cell);
            }
        c.products.make<ParameterMaps>().all.push_back(std::move(map));
    }
    return c;
}

inline Figure mapFigure(const std::string& scheme) {
    const Comparison c = mapComparison();
    View view = c.scene.views[0];
    view.scheme = scheme;
    return makeFigure(c, view);
}

}  // namespace extremal::handmade
