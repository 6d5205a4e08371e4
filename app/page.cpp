// SPDX-License-Identifier: GPL-3.0-or-later
#include <QFileInfo>

#include <memory>

#include "app/load.hpp"
#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "app/watch_run.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/pictures/export_folder.hpp"

namespace extremal::app {

int pageVerb(const std::string& scene, const PageOptions& page, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    if (QFileInfo(QString::fromStdString(page.out)).suffix().toLower() != QLatin1String("html")) {
        printProblem("--out", "pages end in .html, got \"" + page.out + "\"", "for example scene.html");
        return unusable;
    }
    const Offscreen qt;
    try {
        const Replacing replacing = replacingOf(scene, read, options);
        requireReplaceable(page.out, replacing);
        InterruptWatch watch;
        Run run(read.scene, {options.threads});
        run.start();
        const bool isInterrupted = waitFor(run, watch, options);
        ExportParts parts;
        parts.comparison = std::make_shared<const Comparison>(run.latest());
        parts.frames = page.frames;
        for (const View& view : plotViews(read.scene))
            parts.figures.push_back(makeFigure(*parts.comparison, view));
        printFailures(*parts.comparison, sceneName(scene));
        if (isInterrupted) printProblem("", "interrupted: the page shows partial results");
        const std::string text = markedAsOwn(reportPage(parts).toStdString(), "<!-- ", " -->", 1);
        writeFile(page.out, text, replacing);
        const int code = exitCode(*parts.comparison, isInterrupted);
        if (options.isJson) {
            Value document;
            document.set("file", page.out);
            document.set("frames", page.frames);
            document.set("bytes", static_cast<double>(text.size()));
            return print(writeJson(document), code);
        }
        if (options.isQuiet) return code;
        return print(page.out + ": " + std::to_string(page.frames) + " frames, " +
                         std::to_string(text.size() / 1000) + " kB\n",
                     code);
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
}

}  // namespace extremal::app
