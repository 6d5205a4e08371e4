// SPDX-License-Identifier: GPL-3.0-or-later
/// A thousand short runs through the library, each of another step: what `ninja bench-python` compares the
/// Python module with. Prints seconds.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "extremal/extremal.hpp"

int main() {
    using namespace extremal;
    Value document = api::parseJson(R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1]},
        "time": {"end": 10}, "observe": ["energy"], "reference": "none",
        "schemes": [{"label": "midpoint", "scheme": "midpoint", "step": 0.1}]})");
    double best = 1e9, sum = 0;
    for (int repetition = 0; repetition < 5; ++repetition) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < 1000; ++i) {
            document.find("schemes")->asArray()[0].set("step", 0.1 + 1e-6 * i);
            const api::Comparison result = api::run(api::Scene::from(document), 1);
            sum += result[0]["energy_error"].back();
        }
        best =
            std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::printf("%.4f s for 1000 runs (energy errors %.6g)\n", best, sum / 5);
}
