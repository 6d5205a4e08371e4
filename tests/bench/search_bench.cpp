// SPDX-License-Identifier: GPL-3.0-or-later
/// How good the race for the cheapest scheme is: on twelve scenes the cost of what it finds over that of the
/// best of every candidate at every number of steps 6 * 2^(k/3) and tolerance 10^(-1-k/3), and what the
/// search itself takes; and on ten scenes that the rules of the search were not made on. Both answers are
/// timed again, one after the other, five times. `bench.search_bench PART`: those whose title has PART.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/thread_clock.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/search/search_reference.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {
namespace {

struct Task {
    const char* title;
    std::vector<Wish> wishes;
    std::string model, initial;
    double end;
    const char* preset = nullptr;  ///< whose first scheme is the scheme of the scene, in place of a model
};

const std::string verlet = R"({"label":"own","step":0.01,"baseline":"stormer-verlet"})",
                  midpoint = R"({"label":"own","step":0.05,"scheme":"midpoint"})";

std::vector<Task> tasks() {
    const std::string stiff = R"({"type":"spring-pendulum","m":1,"g":9.81,"l":1,"k":1e6})",
                      bent = R"({"q":[0.005,1],"p":[0,0]})", kepler = R"({"type":"kepler","mu":1})";
    return {
        {"spring k=1e6, theta 1e-3", {{"error.theta", 1e-3}}, stiff, bent, 10},
        {"spring k=1e6, theta 1e-6", {{"error.theta", 1e-6}}, stiff, bent, 10},
        {"kepler .6, 1e-6", {{"error", 1e-6}}, kepler, R"({"q":[0.4,0],"p":[0,2]})", 50},
        {"kepler .9, 1e-4", {{"error", 1e-4}}, kepler, R"({"q":[0.1,0],"p":[0,4.358898943540674]})", 20},
        {"henon-heiles, 1e-6",
         {{"error", 1e-6}},
         R"({"type":"henon-heiles"})",
         R"({"q":[0,0.1],"p":[0.4,0.1]})",
         20},
        {"double pendulum, 1e-4",
         {{"error", 1e-4}},
         R"({"type":"double-pendulum"})",
         R"({"q":[2,1.5],"p":[0,0]})",
         5},
        {"pendulum, energy 1e-6", {{"energy", 1e-6}}, R"({"type":"pendulum"})", R"({"q":[2],"p":[0]})", 20},
        {"pendulum, 1e-9", {{"error", 1e-9}}, R"({"type":"pendulum"})", R"({"q":[2],"p":[0]})", 20},
        {"solar system, 1e-3", {{"error", 1e-3}}, R"({"type":"outer-solar-system"})", "", 20000},
        {"free body, 1e-6",
         {{"error", 1e-6}},
         R"({"type":"rigid-body","inertia":[1,2,3]})",
         R"({"omega":[0.3,1,0.2]})",
         100},
        {"charged particle, 1e-5",
         {{"error", 1e-5}},
         R"json({"type":"charged-particle","vector_potential":["-y/2*(1+0.1*z)","x/2*(1+0.1*z)","0"],"scalar_potential":"0.05*z^2"})json",
         R"({"q":[1,0,0],"v":[0,1,0.1]})",
         200},
        {"own, magnetic, driven, 1e-6",
         {{"error", 1e-6}},
         R"json({"type":"lagrangian","coordinates":["x","y"],"lagrangian":"(x_t^2+y_t^2)/2+0.5*(x*y_t-y*x_t)-(x^2+2*y^2)/2+0.3*x*cos(1.3*t)"})json",
         R"({"q":[1,0],"v":[0,0.5]})",
         40},
        {"kepler .6, 1e-3 and energy 1e-8",
         {{"error", 1e-3}, {"energy", 1e-8}},
         kepler,
         R"({"q":[0.4,0],"p":[0,2]})",
         50},
        {"duffing, 1e-8", {{"error", 1e-8}}, {}, {}, 40, "duffing"},
        {"heavy top, 1e-6", {{"error", 1e-6}}, {}, {}, 40, "heavy-top"},
        {"double well, energy 1e-8", {{"energy", 1e-8}}, {}, {}, 200, "double-well"},
        {"forced pendulum, 1e-5", {{"error", 1e-5}}, {}, {}, 10, "forced-pendulum"},
        {"spring k=1e4, angle 1e-5", {{"error.theta", 1e-5}}, {}, {}, 10, "spring-pendulum"},
        {"chain with stiff springs, 1e-4", {{"error", 1e-4}}, {}, {}, 20, "fput-chain"},
        {"three bodies, 1e-6", {{"error", 1e-6}}, {}, {}, 3, "three-bodies"},
        {"van der pol, 1e-7", {{"error", 1e-7}}, {}, {}, 40, "van-der-pol"},
        {"vortices, 1e-8", {{"error", 1e-8}}, {}, {}, 60, "vortices"},
        {"rod and ball, 1e-6", {{"error", 1e-6}}, {}, {}, 10, "rod-and-ball"},
    };
}

/// The scene of a task; null with what is wrong with it printed.
std::shared_ptr<const ResolvedScene> sceneOf(const Task& task) {
    const bool isBody = task.model.find("rigid-body") != std::string::npos;
    const std::string json = R"({"extremal":1,"model":)" + task.model +
                             (task.initial.empty() ? "" : R"(,"initial":)" + task.initial) +
                             R"(,"time":{"end":)" + std::to_string(task.end) + R"(},"schemes":[)" +
                             (isBody ? R"({"label":"own","step":0.05,"scheme":"lie-2"})"
                              : task.model.find("outer") != std::string::npos
                                  ? R"({"label":"own","step":100,"baseline":"stormer-verlet"})"
                              : task.model.find("double-p") != std::string::npos ? midpoint
                                                                                 : verlet) +
                             "]}";
    const ReadScene read = task.preset ? readScene(findPreset(task.preset)->json) : readScene(json);
    for (const Problem& p : read.errors)
        std::printf("%-32s %s: %s\n", task.title, p.pointer.c_str(), p.message.c_str());
    if (!read.resolved || !task.preset) return read.resolved;
    Scene scene = read.resolved->scene;
    scene.schemes.resize(1);
    scene.schemes.front().label = "own";
    scene.end = {task.end, {}};
    scene.observe.clear();
    return std::make_shared<const ResolvedScene>(resolve(scene));
}

bool reaches(const PointResult& r, const std::vector<Wish>& wishes) {
    for (std::size_t i = 0; i < wishes.size(); ++i)
        if (!(r.isDone() && (r.errors.empty() ? r.error : r.errors[i]) <= wishes[i].value)) return false;
    return true;
}

void run(const Task& task, double& sumOfLogs, int& count) {
    const std::shared_ptr<const ResolvedScene> resolved = sceneOf(task);
    if (!resolved) return;
    const double begin = threadSeconds();
    SweepOptions options;
    options.metric = task.wishes.front().metric;
    options.wantedError = task.wishes.front().value;
    options.wishes.assign(task.wishes.begin() + 1, task.wishes.end());
    options.hasAllCandidates = true;
    options.only = {"own"};
    Sweep sweep(*resolved, options);
    const double gathered = threadSeconds();
    double referenced = gathered;
    sweep.run([&](const ReferenceInfo&) { referenced = threadSeconds(); }, {}, {});
    const double searched = threadSeconds();

    const SweepRow* found = nullptr;
    for (const SweepRow& row : sweep.rows())
        if (row.result.isDone() && (!found || row.result.cpuSeconds < found->result.cpuSeconds)) found = &row;
    if (!found) {
        std::printf("%-32s no scheme found: %s\n", task.title, sweep.rows().front().result.reason.c_str());
        return;
    }
    const ResolvedScene& scene = sweep.scene();
    const SearchReference reference(scene, sweep.metrics(), {});
    std::vector<Metric> metrics = sweep.metrics();
    for (Metric& metric : metrics) metric = reference.sized(metric, scene);
    const double length = task.end;
    struct Good {
        double seconds;
        StudyPoint point;
    };
    std::vector<Good> good;
    ProcessorWatch watch;
    double best = found->result.cpuSeconds;
    for (const SweepRow& row : sweep.rows()) {
        const ResolvedScheme& scheme = scene.schemes[row.point.scheme];
        for (int k = 0; k < 60; ++k) {
            StudyPoint point = row.point;
            if (scheme.isAdaptive())
                point.tolerance = std::pow(10.0, -1 - k / 3.0);
            else
                point.step = length / std::round(6 * std::pow(2.0, k / 3.0));
            if (scheme.isAdaptive() && point.tolerance < 1e-15) break;
            const CostLimit limit{.seconds = 1.5 * best, .watch = &watch};
            const PointResult r = runPoint(scene, point, metrics, reference.of(scheme), 0, limit, {});
            if (r.isCutOff && !scheme.isAdaptive() && k > 12) break;
            if (!reaches(r, task.wishes)) continue;
            good.push_back({r.cpuSeconds, point});
            best = std::min(best, r.cpuSeconds);
        }
    }
    const auto timed = [&](const StudyPoint& point) {
        double least = HUGE_VAL;
        for (int i = 0; i < 3; ++i)
            least = std::min(
                least, runPoint(scene, point, metrics, reference.of(scene.schemes[point.scheme]), 5, {}, {})
                           .cpuSeconds);
        return least;
    };
    StudyPoint at = found->point;
    at.step = found->result.step;
    at.tolerance = found->result.tolerance;
    at.reduction = found->result.reduction;
    const double answer = timed(at);
    std::sort(good.begin(), good.end(), [](const Good& a, const Good& b) { return a.seconds < b.seconds; });
    double least = answer;
    std::string leastLabel = scene.schemes[at.scheme].spec.label;
    for (std::size_t i = 0; i < std::min<std::size_t>(6, good.size()); ++i)
        if (const double seconds = timed(good[i].point); seconds < least) {
            least = seconds;
            leastLabel = scene.schemes[good[i].point.scheme].spec.label;
        }
    sumOfLogs += std::log(answer / least);
    ++count;
    std::printf(
        "%-32s %3zu | best %-22s %9.2e | found %-22s %9.2e | regret %.2f | CPU ms: gather %4.0f, "
        "reference %4.0f, search %4.0f\n",
        task.title, sweep.rows().size(), leastLabel.c_str(), least,
        scene.schemes[at.scheme].spec.label.c_str(), answer, answer / least, 1e3 * (gathered - begin),
        1e3 * (referenced - gathered), 1e3 * (searched - referenced));
    std::fflush(stdout);
}

}  // namespace
}  // namespace extremal

int main(int argc, char** argv) {
    double sumOfLogs = 0;
    int count = 0;
    for (const extremal::Task& task : extremal::tasks())
        if (argc < 2 || std::string(task.title).find(argv[1]) != std::string::npos)
            extremal::run(task, sumOfLogs, count);
    std::printf("regret, geometric mean of %d: %.3f\n", count, std::exp(sumOfLogs / std::max(1, count)));
}
