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

Splitting strangSteps(int order, const std::vector<double>& parts) {
    std::vector<double> kicks{parts.front() / 2};
    for (std::size_t i = 1; i < parts.size(); ++i) kicks.push_back((parts[i - 1] + parts[i]) / 2);
    kicks.push_back(parts.back() / 2);
    return alternating(order, false, true, kicks, parts);
}

Splitting suzuki4() {
    const double g = 1 / (4 - std::cbrt(4.0));
    return strangSteps(4, {g, g, 1 - 4 * g, g, g});
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

Splitting srkn19a() {
    return alternating(8, true, false,
                       palindrome({0.0505805, 0.149999, -0.0551795510771615573511026950361,
                                   0.423755898835337951482264998051, -0.213495353584659048059672194633,
                                   -0.0680769774574032619111630736274, 0.227917056974013435948887201671,
                                   -0.235373619381058906524740047732, 0.387413869179878047816794031058},
                                  20),
                       palindrome({0.129478606560536730662493794395, 0.222257260092671143423043559581,
                                   -0.0577514893325147204757023246320, -0.0578312262103924910221345032763,
                                   0.103087297437175356747933252265, -0.140819612554090768205554103887,
                                   0.0234462603492826276699713718626, 0.134854517356684096617882205068,
                                   0.0287973821073779306345172160211},
                                  19));
}

Splitting srkn19b() {
    return alternating(8, true, true,
                       palindrome({0.036132460472136313416730168194, 0.012697863961074113381675193011,
                                   0.201318391240629276109068041836, 0.135683350134504233201330671671,
                                   -0.0579071833999963041504740663015, -0.0772509501792649549463874931821,
                                   -0.00264758266409925952822161203471, -0.0329844384945603065320797537355,
                                   0.0476781560950366927530646289755},
                                  20),
                       palindrome({0.337548675291317241942440116575, -0.223647977575409990331768222380,
                                   0.168949714872223740906385138015, 0.171179938816205886154783136334,
                                   -0.349765168067292877221144631312, 0.523808861006312397712070357524,
                                   -0.194208871063049124066394765282, -0.323496751337931087309823477561,
                                   0.322817287614899749216601693799},
                                  19));
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
