// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of groups: a free body compiled, as data in several bases and in quaternions; SO(4); products of
/// bodies, free and in a potential. Nanoseconds a step, the least of several runs in one process.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/family/scheme.hpp"
#include "tests/bench/cpu_time.hpp"
#include "tests/laws/matrix_groups.hpp"

namespace extremal::bench {
namespace {

using namespace laws;

/// Nanoseconds of a step; 0 where one fails.
double nanoseconds(const System& system, const State& start, const Discretization& scheme, double h) {
    const auto integrator = makeIntegrator(system, scheme, {0, h});
    double best = 1e300;
    for (int run = 0; run < 7; ++run) {
        State state = start;
        integrator->begin(state);
        long long steps = 0;
        const double from = cpuSeconds();
        double now = from;
        for (; now < from + 0.04; now = cpuSeconds())
            for (int k = 0; k < 20; ++k, ++steps)
                if (advance(*integrator, state).outcome != Outcome::converged) return 0;
        best = std::min(best, (now - from) / static_cast<double>(steps));
    }
    return 1e9 * best;
}

double ofGroup(const GroupCase& each, int degree, double h) {
    const System system = each.system();
    return nanoseconds(system, each.start(system), liePair(degree), h);
}

/// Bodies in a row, each with its own inertia; the vertical axes of neighbours attract each other.
GroupCase bodies(int count, bool isFree) {
    static std::vector<std::string> texts;
    Value::Object factors;
    std::string L;
    GroupCase made{"bodies", {}, "", {}, {}, 1, 1};
    for (int k = 0; k < count; ++k) {
        const std::string name = "b" + std::to_string(k), xi = name + "_xi";
        factors.emplace_back(name, "so3");
        L += (k > 0 ? "+(" : "(") + xi + "1^2 + 2*" + xi + "2^2 + 3*" + xi + "3^2)/2";
        for (const double rate : {0.4, 0.1 + 0.05 * k, 0.3}) made.xi.push_back(rate);
        if (!isFree && k > 0) {
            const std::string before = "b" + std::to_string(k - 1);
            for (const char* row : {"13", "23", "33"})
                L += "+ 0.5*" + name + "_g" + row + "*" + before + "_g" + row;
        }
    }
    made.group = Value::Object{{"product", factors}};
    texts.push_back(L);
    made.lagrangian = texts.back().c_str();
    return made;
}

void rotations() {
    const System compiled = standard().system();
    const State start = bodyState(standard().start);
    const GroupCase data = freeBodyAsData(), su2 = groupCases()[2];
    const auto basisOf = [](double a, double b, double c, double slant) {
        const auto matrix = [](std::vector<double> m) {
            Value::Array rows;
            for (int i = 0; i < 3; ++i) rows.emplace_back(Value::Array{m[3 * i], m[3 * i + 1], m[3 * i + 2]});
            return Value(rows);
        };
        return Value(Value::Object{{"basis", Value::Array{matrix({0, 0, b, 0, 0, slant, -b, -slant, 0}),
                                                          matrix({0, 0, 0, 0, 0, -a, 0, a, 0}),
                                                          matrix({0, -c, 0, c, 0, 0, 0, 0, 0})}}});
    };
    GroupCase scaled = data, slanting = data;
    scaled.group = basisOf(2, 0.5, 3, 0);
    slanting.group = basisOf(2, 0.5, 3, 0.3);
    std::printf("free body, h = 0.2       degree 1      2      3      4\n");
    const auto row = [&](const char* name, const auto& of) {
        std::printf("%-24s", name);
        for (const int degree : {1, 2, 3, 4}) std::printf(" %6.0f", of(degree));
        std::printf("\n");
    };
    row("compiled", [&](int s) { return nanoseconds(compiled, start, liePair(s), 0.2); });
    row("so3", [&](int s) { return ofGroup(data, s, 0.2); });
    row("su2", [&](int s) { return ofGroup(su2, s, 0.2); });
    row("permuted and scaled", [&](int s) { return ofGroup(scaled, s, 0.2); });
    row("slanting", [&](int s) { return ofGroup(slanting, s, 0.2); });
    row("compiled again", [&](int s) { return nanoseconds(compiled, start, liePair(s), 0.2); });
    row("in quaternions", [&](int s) {
        return nanoseconds(compiled, start, *namedScheme("quaternion-" + std::to_string(s)), 0.2);
    });
    const System top = laws::top().system();
    std::printf("heavy top, h = 0.1\n");
    row("compiled", [&](int s) { return nanoseconds(top, bodyState(laws::top().start), liePair(s), 0.1); });
    row("so3", [&](int s) { return ofGroup(heavyTopAsData(), s, 0.1); });
    std::printf("others, h = 0.1\n");
    for (const int k : {3, 4, 5, 7, 9, 10}) {
        const GroupCase each = groupCases()[static_cast<std::size_t>(k)];
        row(each.name, [&](int s) { return ofGroup(each, s, 0.1); });
    }
}

void products() {
    std::printf("bodies in a product, degree 2, h = 0.1: us a step and body, free and in a potential\n");
    for (const int count : {1, 2, 4, 8, 16, 64, 256})
        std::printf("%4d %8.2f %8.2f\n", count, ofGroup(bodies(count, true), 2, 0.1) / count / 1e3,
                    ofGroup(bodies(count, false), 2, 0.1) / count / 1e3);
}

/// A million steps: the distance from the group, what J of free motions has moved, and the energy's largest
/// errors in four quarters.
void longRuns(double steps) {
    const auto all = groupCases();
    for (const std::size_t k : {0, 1, 2, 3, 4, 5, 7}) {
        const GroupCase& each = all[k];
        const System system = each.system();
        const GroupMechanics& on = *system.part<LieGroup>().mechanics;
        const State start = each.start(system);
        const auto integrator = makeIntegrator(system, liePair(2), {0, 0.1});
        const auto off = measureOf(system, "group-distance")->bind(start);
        State state = start;
        integrator->begin(state);
        const auto count = static_cast<long long>(steps);
        double energy[4] = {}, farthest = 0;
        const double before = system.energy(0, start.x.data());
        for (long long i = 0; i < count; ++i) {
            if (advance(*integrator, state).outcome != Outcome::converged) break;
            if (i % 10) continue;
            double& worst = energy[4 * i / count];
            worst = std::max(worst, std::abs(system.energy(0, state.x.data()) - before));
            double distance = 0;
            off(0, state.x.data(), &distance);
            farthest = std::max(farthest, distance);
        }
        const auto d = static_cast<std::size_t>(on.dimension()),
                   J = static_cast<std::size_t>(on.group->entries()) + d;
        double kept = 0;
        for (const MomentumMap& each : system.momenta)
            kept = std::max(kept, std::abs(each.value(state.x.data(), state.x.data()) -
                                           each.value(start.x.data(), start.x.data())));
        std::printf("%-24s distance %.1e, J %.1e, kept momenta %.1e, energy %.3e %.3e %.3e %.3e\n", each.name,
                    farthest, on.isInvariant ? distance(state.x, start.x, J, J + d) : std::nan(""), kept,
                    energy[0], energy[1], energy[2], energy[3]);
        std::fflush(stdout);
    }
}

}  // namespace
}  // namespace extremal::bench

/// Arguments: none for the costs, or a number of steps for long runs.
int main(int count, char** arguments) {
    if (count > 1) {
        extremal::bench::longRuns(std::atof(arguments[1]));
        return 0;
    }
    extremal::bench::rotations();
    extremal::bench::products();
}
