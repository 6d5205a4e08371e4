// SPDX-License-Identifier: GPL-3.0-or-later
#include <extremal/extremal.hpp>

#include <fstream>
#include <iostream>

using namespace extremal::api;

struct Quartic {  // L = x_t^2 / 2 - c x^4 / 4
    static constexpr int dimension = 1;
    double c;
    template <class S>
    S lagrangian(double, const std::array<S, 1>& q, const std::array<S, 1>& v) const {
        return square(v[0]) * 0.5 - square(square(q[0])) * (c / 4);
    }
};

int main() try {
    addSystem({"quartic", "quartic oscillator", {{"x"}}, {{"c", 1}}},
              [](const Parameters& p) { return Quartic{p["c"]}; });
    const Scene scene = Scene::parse(R"({"extremal": 1, "title": "A quartic well", "observe": ["energy"],
        "model": {"type": "quartic", "c": 2}, "initial": {"q": [1]}, "time": {"end": 20},
        "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.1}, {"baseline": "rk4", "step": 0.1}]})");
    const Comparison result =
        run(scene, 0, [](double fraction) { return std::cerr << fraction << '\r', true; });
    for (std::size_t i = 0; i < result.size(); ++i)
        std::cout << result[i].label() << ": energy error " << result[i]["energy_error"].back() << '\n';
    std::ofstream("energy.svg") << figure(result, "energy").svg();
} catch (const extremal::InvalidScene& e) {
    std::cerr << e.what() << '\n';
    return 2;
}
