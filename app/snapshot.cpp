// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>

#include "app/load.hpp"
#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "app/watch_run.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/pictures/snapshot.hpp"

namespace extremal::app {
namespace {

/// "1200x800".
std::optional<std::pair<int, int>> parseSize(const std::string& text) {
    int width = 0, height = 0;
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, width);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != 'x') return std::nullopt;
    const auto second = std::from_chars(first.ptr + 1, end, height);
    if (second.ec != std::errc() || second.ptr != end) return std::nullopt;
    return std::pair(width, height);
}

SnapshotRequest requestOf(const SnapshotOptions& options) {
    SnapshotRequest request;
    const auto size = parseSize(options.size);
    if (!size)
        throw SnapshotError(SnapshotError::Kind::unusable, "--size",
                            "must be WIDTHxHEIGHT, got \"" + options.size + "\"", "for example 1200x800");
    request.file = QString::fromStdString(options.out);
    request.width = size->first;
    request.height = size->second;
    request.view = options.view;
    if (options.hasTime) request.time = options.time;
    request.compareWith = QString::fromStdString(options.compareWith);
    if (options.tolerance >= 0) request.tolerance = options.tolerance;
    return request;
}

/// Prints what was made; returns the exit code, which writing to a full disk can change.
int printSnapshot(const SnapshotOptions& snapshot, const SnapshotRequest& request,
                  const SnapshotResult& result, int code, const CommonOptions& options) {
    if (options.isJson) {
        Value document;
        document.set("file", snapshot.out);
        document.set("width", request.width);
        document.set("height", request.height);
        document.set("view", request.view);
        document.set("time", result.time);
        if (result.isCompared) {
            document.set("equal", result.isEqual);
            document.set("differing_percent", result.differingPercent);
            document.set("difference", result.differenceFile.toStdString());
        }
        return print(writeJson(document), code);
    }
    if (options.isQuiet) return code;
    std::string text = snapshot.out + ": " + std::to_string(request.width) + "x" +
                       std::to_string(request.height) + ", view " + request.view +
                       ", t = " + formatNumber(result.time) + "\n";
    if (result.isCompared)
        text +=
            snapshot.compareWith + ": " + (result.isEqual ? "equal, " : "differs, ") + result.verdict + "\n";
    return print(text, code);
}

}  // namespace

Scene withView(const Scene& scene, const std::string& view) {
    if (std::any_of(scene.views.begin(), scene.views.end(), [&](const View& v) { return v.id == view; }))
        return scene;
    ReadScene wider = readScene(toValue(scene), {{"/views/-", view}});
    if (!wider.errors.empty())
        throw SnapshotError(SnapshotError::Kind::unusable, "--view",
                            "the view " + view + " is not for this scene: " + wider.errors.front().message,
                            wider.errors.front().hint);
    return std::move(wider.scene);
}

int snapshotVerb(const std::string& scene, const SnapshotOptions& snapshot, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    const Offscreen qt;
    try {
        SnapshotRequest request = requestOf(snapshot);
        request.replacing = replacingOf(scene, read, options);
        checkSnapshot(read.scene, request);
        InterruptWatch watch;
        Scene shown = request.view == "all" ? read.scene : withView(read.scene, request.view);
        Run run(shown, {options.threads});
        run.start();
        const bool isInterrupted = waitFor(run, watch, options);
        const auto comparison = std::make_shared<const Comparison>(run.latest());
        const SnapshotResult result = makeSnapshot(comparison, request);
        // Comparing asks about the picture, which shows failures as it should; else they are the news.
        const bool isVerdict = result.isCompared && !isInterrupted;
        if (!isVerdict) printFailures(*comparison, sceneName(scene));
        const int code = isVerdict ? (result.isEqual ? done : failed) : exitCode(*comparison, isInterrupted);
        if (isInterrupted) printProblem("", "interrupted: the picture shows partial results");
        return printSnapshot(snapshot, request, result, code, options);
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    } catch (const SnapshotError& e) {
        return tellUndrawn(e);
    }
}

}  // namespace extremal::app
