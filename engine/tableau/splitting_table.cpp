// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/tableau/splitting_table.hpp"

#include <cmath>
#include <numeric>

#include "engine/quadrature/rule.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {
namespace {

/// A palindrome of `count` coefficients with sum 1 from its first ones: the one or two in the middle follow.
std::vector<double> palindrome(std::vector<double> first, std::size_t count) {
    const double rest = 1 - 2 * std::accumulate(first.begin(), first.end(), 0.0);
    std::vector<double> all = first;
    if (count % 2 == 0)
        all.insert(all.end(), 2, rest / 2);
    else
        all.push_back(rest);
    all.insert(all.end(), first.rbegin(), first.rend());
    return all;
}

/// The second half is made the first one backwards: nodes are symmetric to round-off.
std::vector<double> mirrored(std::vector<double> all) {
    for (std::size_t i = 0; i < all.size() / 2; ++i) all[all.size() - 1 - i] = all[i];
    return all;
}

/// outer[0] inner[0] outer[1] ...; the outer ones are kicks or drifts.
Splitting alternating(int order, bool isNystrom, bool isKickFirst, const std::vector<double>& outer,
                      const std::vector<double>& inner) {
    Splitting s{order, isNystrom, {}};
    for (std::size_t i = 0; i < outer.size(); ++i) {
        s.stages.push_back({isKickFirst, outer[i]});
        if (i < inner.size()) s.stages.push_back({!isKickFirst, inner[i]});
    }
    return s;
}

}  // namespace

Splitting strang() { return alternating(2, false, true, {0.5, 0.5}, {1}); }

Splitting suzuki4() {
    const double g = 1 / (4 - std::cbrt(4.0)), m = 1 - 4 * g;
    return alternating(4, false, true, {g / 2, g, (g + m) / 2, (g + m) / 2, g, g / 2}, {g, g, m, g, g});
}

Splitting blanesMoanS6() {
    return alternating(4, false, true,
                       palindrome({0.0792036964311957, 0.353172906049774, -0.0420650803577195}, 7),
                       palindrome({0.209515106613362, -0.143851773179818}, 6));
}

Splitting blanesMoanS10() {
    return alternating(
        6, false, true,
        palindrome({0.0502627644003922, 0.413514300428344, 0.0450798897943977, -0.188054853819569,
                    0.541960678450780},
                   11),
        palindrome({0.148816447901042, -0.132385865767784, 0.067307604692185, 0.432666402578175}, 10));
}

Splitting srkn6b() {
    return alternating(4, true, true,
                       palindrome({0.0829844064174052, 0.396309801498368, -0.0390563049223486}, 7),
                       palindrome({0.245298957184271, 0.604872665711080}, 6));
}

Splitting srkn11b() {
    return alternating(6, true, true,
                       palindrome({0.0414649985182624, 0.198128671918067, -0.0400061921041533,
                                   0.0752539843015807, -0.0115113874206879},
                                  12),
                       palindrome({0.123229775946271, 0.290553797799558, -0.127049212625417,
                                   -0.246331761062075, 0.357208872795928},
                                  11));
}

Splitting srkn14a() {
    return alternating(
        6, true, false,
        palindrome({0.0378593198406116, 0.102635633102435, -0.0258678882665587, 0.314241403071447,
                    -0.130144459517415, 0.106417700369543, -0.00879424312851058},
                   15),
        palindrome({0.09171915262446165, 0.183983170005006, -0.05653436583288827, 0.004914688774712854,
                    0.143761127168358, 0.328567693746804},
                   14));
}

Splitting gaussKicks(int n) {
    const Rule<double> rule = gauss<double>(n);
    std::vector<double> drifts{rule.c.front()};
    for (std::size_t i = 1; i < rule.c.size(); ++i) drifts.push_back(rule.c[i] - rule.c[i - 1]);
    drifts.push_back(drifts.front());
    return alternating(2, false, false, mirrored(drifts), mirrored(rule.b));
}

Splitting lobattoKicks(int n) {
    const Rule<double> rule = lobatto<double>(n);
    std::vector<double> drifts;
    for (std::size_t i = 1; i < rule.c.size(); ++i) drifts.push_back(rule.c[i] - rule.c[i - 1]);
    return alternating(2, false, true, mirrored(rule.b), mirrored(drifts));
}

Splitting aba104() {
    return alternating(
        4, false, false,
        palindrome({0.04706710064597250612947887637243678556564, 0.1847569354170881069247376193702560968574,
                    0.2827060056798362053243616565541452479160},
                   8),
        palindrome({0.1188819173681970199453503950853885936957, 0.2410504605515015657441667865901651105675,
                    -0.2732866667053238060543113981664559460630},
                   7));
}

Splitting aba864() {
    return alternating(
        4, false, false,
        palindrome({0.0711334264982231177779387300061549964174, 0.241153427956640098736487795326289649618,
                    0.521411761772814789212136078067994229991},
                   8),
        palindrome({0.183083687472197221961703757166430291072, 0.310782859898574869507522291054262796375,
                    -0.0265646185119588006972121379164987592663},
                   7));
}

Splitting aba1064() {
    return alternating(
        4, false, false,
        palindrome({0.03809449742241219545697532230863756534060, 0.1452987161169137492940200726606637497442,
                    0.2076276957255412507162056113249882065158, 0.4359097036515261592231548624010651844006},
                   9),
        palindrome({0.09585888083707521061077150377145884776921, 0.2044461531429987806805077839164344779763,
                    0.2170703479789911017143385924306336714532},
                   8));
}

std::shared_ptr<const Tableau> tableauOf(const std::vector<SplittingStage>& stages, double known) {
    std::vector<TableauFlow> flows;
    for (const SplittingStage& s : stages) flows.push_back({s.isKick, Quad(s.fraction)});
    auto tableau = std::make_shared<Tableau>(splittingTableau(flows));
    tableau->known = known;
    return tableau;
}

double halfTrace(const std::vector<SplittingStage>& stages, double z) {
    // Columns: the images of (q, p) = (1, 0) and (0, 1), with p in units of the frequency.
    double q[2] = {1, 0}, p[2] = {0, 1};
    for (const SplittingStage& s : stages)
        for (int i = 0; i < 2; ++i) {
            if (s.isKick)
                p[i] -= s.fraction * z * q[i];
            else
                q[i] += s.fraction * z * p[i];
        }
    return (q[0] + p[1]) / 2;
}

}  // namespace extremal
