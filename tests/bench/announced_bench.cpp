// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the studies of every preset end within twice the time that they announce, on one thread, and how
/// much of that they need. Arguments: presets whose name contains the first; and the most seconds of a study,
/// where a study that announces more is taken of the scene with an end that much nearer; and the first and
/// the last preset to look at, in the order of their names.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/request.hpp"

namespace extremal {
namespace {

void run(Sweep& study, const std::stop_token& stop) { study.run({}, {}, stop); }
template <class Study>
void run(Study& study, const std::stop_token& stop) {
    study.run([](std::size_t) {}, stop);
}

struct Tally {
    int studies = 0, late = 0;
    double longest = 0;
};

/// Runs the study. False: it announced more than `most`, which is then what it announced, and was stopped.
bool runUnlessLonger(AnyStudy& study, double& most) {
    return std::visit(
        [&most](auto& each) {
            std::stop_source stop;
            {
                const std::jthread watch([&](const std::stop_token& isOver) {
                    // What a search is cut off at does not depend on the scene.
                    const auto isShort = [&] {
                        return each.announced().isLimit || each.announced().seconds <= most;
                    };
                    while (!isOver.stop_requested() && isShort())
                        std::this_thread::sleep_for(std::chrono::milliseconds(2));
                    if (!isOver.stop_requested()) stop.request_stop();
                });
                run(each, stop.get_token());
            }
            if (!stop.stop_requested()) return true;
            most = each.announced().seconds;
            return false;
        },
        study);
}

/// False: the scene does not take this study.
bool measure(const Preset& preset, const ResolvedScene& whole, const StudyRequest& request, double most,
             Tally& tally) {
    try {
        ResolvedScene scene = whole;
        double begin, part = 1;
        std::optional<AnyStudy> study;
        for (;;) {
            study = makeStudy(knownStudy(request), request, &scene, 1);
            double announced = most;
            begin = threadSeconds();
            if (runUnlessLonger(*study, announced)) break;
            part *= 0.9 * most / announced;
            Scene shorter = whole.scene;
            shorter.end = {shorter.start.value + part * (shorter.end.value - shorter.start.value), {}};
            scene = resolve(shorter);
        }
        const double spent = threadSeconds() - begin;
        const double announced = std::visit([](auto& each) { return each.announced().seconds; }, *study);
        const double ratio = announced > 0 ? spent / announced : 0;
        // Less than a second is not announced to anybody.
        const bool isLate = spent > 1 && !(ratio <= 2);
        ++tally.studies;
        tally.late += isLate;
        tally.longest = std::fmax(tally.longest, spent);
        std::printf("%-28s %-18s %9.3f s of %9.3f announced %6.2f", std::string(preset.id).c_str(),
                    request.kind.c_str(), spent, announced, ratio);
        if (part < 1) std::printf("  to %.2g of the end", part);
        std::printf("%s\n", isLate ? "  LATE" : "");
        std::fflush(stdout);
        return true;
    } catch (const InvalidScene&) {
        return false;
    }
}

void measureAll(const Preset& preset, double most, Tally& tally) {
    const ReadScene read = readScene(preset.json);
    if (!read.resolved) return;
    const ResolvedScene& scene = *read.resolved;
    const double step = scene.schemes.front().spec.step.value;
    for (const char* metric : {"error", "energy"}) {
        bool isDone = true;
        for (const char* kind : {"convergence", "work-precision", "cheapest", "limits", "needs"}) {
            StudyRequest request;
            request.kind = kind;
            request.metric = metric;
            if (request.kind == "cheapest") request.error = 1e-4;
            isDone = measure(preset, scene, request, most, tally) && isDone;
        }
        if (isDone) break;
    }
    StudyRequest linear;
    linear.kind = "linear-stability";
    measure(preset, scene, linear, most, tally);
    for (const char* kind : {"stability", "extremes"}) {
        StudyRequest request;
        request.kind = kind;
        request.x = "/schemes/*/step=" + std::to_string(step) + ":" + std::to_string(8 * step) + ":8:log";
        if (step > 0) measure(preset, scene, request, most, tally);
    }
}

}  // namespace
}  // namespace extremal

int main(int argc, char** argv) {
    using namespace extremal;
    const std::string wanted = argc > 1 ? argv[1] : "";
    const double most = argc > 2 ? std::atof(argv[2]) : INFINITY;
    const std::string first = argc > 3 ? argv[3] : "", last = argc > 4 ? argv[4] : "~";
    Tally tally;
    for (const Preset& preset : presets())
        if (preset.id.find(wanted) != std::string::npos && preset.id >= first && preset.id <= last)
            measureAll(preset, most, tally);
    std::printf("%d studies, %d of them took more than twice what they announced; the longest %.1f s\n",
                tally.studies, tally.late, tally.longest);
    return tally.late == 0 ? 0 : 1;
}
