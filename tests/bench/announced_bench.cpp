// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the studies of every preset end within twice the time that they announce, on one thread, and how
/// much of that they need. An argument: presets whose name contains it.
#include <cmath>
#include <cstdio>
#include <string>
#include <variant>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/request.hpp"

namespace extremal {
namespace {

void run(Sweep& study) { study.run({}, {}, {}); }
template <class Study>
void run(Study& study) {
    study.run([](std::size_t) {}, {});
}

struct Tally {
    int studies = 0, late = 0;
    double longest = 0;
};

/// False: the scene does not take this study.
bool measure(const Preset& preset, const ResolvedScene& scene, const StudyRequest& request, Tally& tally) {
    try {
        AnyStudy study = makeStudy(knownStudy(request), request, &scene, 1);
        const double begin = threadSeconds();
        std::visit([](auto& each) { run(each); }, study);
        const double spent = threadSeconds() - begin;
        const double announced = std::visit([](auto& each) { return each.announced().seconds; }, study);
        const double ratio = announced > 0 ? spent / announced : 0;
        // Less than a second is not announced to anybody.
        const bool isLate = spent > 1 && !(ratio <= 2);
        ++tally.studies;
        tally.late += isLate;
        tally.longest = std::fmax(tally.longest, spent);
        std::printf("%-28s %-18s %9.3f s of %9.3f announced %6.2f%s\n", std::string(preset.id).c_str(),
                    request.kind.c_str(), spent, announced, ratio, isLate ? "  LATE" : "");
        std::fflush(stdout);
        return true;
    } catch (const InvalidScene&) {
        return false;
    }
}

void measureAll(const Preset& preset, Tally& tally) {
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
            isDone = measure(preset, scene, request, tally) && isDone;
        }
        if (isDone) break;
    }
    StudyRequest linear;
    linear.kind = "linear-stability";
    measure(preset, scene, linear, tally);
    for (const char* kind : {"stability", "extremes"}) {
        StudyRequest request;
        request.kind = kind;
        request.x = "/schemes/*/step=" + std::to_string(step) + ":" + std::to_string(8 * step) + ":8:log";
        if (step > 0) measure(preset, scene, request, tally);
    }
}

}  // namespace
}  // namespace extremal

int main(int argc, char** argv) {
    using namespace extremal;
    const std::string wanted = argc > 1 ? argv[1] : "";
    Tally tally;
    for (const Preset& preset : presets())
        if (preset.id.find(wanted) != std::string::npos) measureAll(preset, tally);
    std::printf("%d studies, %d of them took more than twice what they announced; the longest %.1f s\n",
                tally.studies, tally.late, tally.longest);
    return tally.late == 0 ? 0 : 1;
}
