// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs that are stopped on their way go on from their checkpoints to the bytes of the whole run: a scene of
/// every family, and of everything that is recorded along a run.
#include <QTemporaryDir>
#include <QTest>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include "engine/core/problem.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::checkpoint_test {
namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

using Files = std::map<std::string, std::string>;

/// By their names, without the times of the processor.
Files exported(Comparison comparison, const fs::path& folder) {
    for (auto& scheme : comparison.schemes) {
        auto untimed = std::make_shared<SchemeResult>(*scheme);
        untimed->summary.cpuSeconds = 0;
        scheme = untimed;
    }
    Files files;
    for (const std::string& name : exportComparison(comparison, folder))
        files[name] = contents(folder / name);
    return files;
}

/// The first difference, or nothing.
std::string difference(const Files& here, const Files& there) {
    for (const auto& [name, text] : here) {
        if (!there.contains(name)) return name + " is only here";
        std::istringstream a(text), b(there.at(name));
        std::string one, other;
        for (int line = 1; std::getline(a, one) && std::getline(b, other); ++line)
            if (one != other) return name + ", line " + std::to_string(line) + ":\n" + one + "\n" + other;
        if (text.size() != there.at(name).size()) return name + " has another length";
    }
    return here.size() == there.size() ? "" : "there are more files";
}

Scene sceneOf(const std::string& preset, const std::vector<std::string>& changes) {
    std::vector<Override> overrides;
    for (const std::string& change : changes) overrides.push_back(parseOverride(change));
    ReadScene read = readScene(findPreset(preset)->json, overrides);
    for (const Problem& p : read.errors) qWarning("%s %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

/// A checkpoint at every opportunity.
RunOptions often(const fs::path& folder, bool isResumed) {
    RunOptions options;
    options.threads = 1;
    options.isTimed = false;
    options.checkpoints = {folder, "test", 1e-9, isResumed};
    return options;
}

/// Runs a scene as far as a part of the whole. False where it came to its end.
bool runTo(const Scene& scene, double part, const fs::path& folder, bool isResumed) {
    Run run(scene, often(folder, isResumed));
    run.start();
    while (!run.isFinished() && run.fraction() < part) std::this_thread::yield();
    run.stop();
    run.wait();
    for (const auto& scheme : run.latest().schemes)
        if (scheme->summary.status == RunStatus::partial) return true;
    return false;
}

}  // namespace

class CheckpointTest : public QObject {
    Q_OBJECT
private slots:
    void aRunThatWasStoppedGoesOnToTheSameBytes_data() {
        QTest::addColumn<QString>("preset");
        QTest::addColumn<QStringList>("changes");
        const auto add = [](const char* name, const char* preset, const QStringList& changes = {}) {
            QTest::addRow("%s", name) << preset << changes;
        };
        add("galerkin, multiscale", "spring-pendulum", {"/time/end=8"});
        add("compositions", "compositions", {"/time/end=150"});
        add("energy and momentum", "kepler-sem", {"/time/end=200"});
        add("lie", "heavy-top", {"/time/end=40"});
        add("wave", "schrodinger-seed", {"/time/end=4"});
        add("field", "klein-gordon", {"/time/end=60"});
        add("moving mesh", "kink-moving-mesh");
        add("asynchronous", "bar-notch", {"/time/end=3"});
        add("elliptic", "elliptic");
        add("free knots", "free-knots");
        add("baselines", "kepler", {"/time/end=1000"});
        add("companions", "error-bars", {"/time/end=200"});
        add("modified energy", "modified-energy", {"/time/end=2000"});
        add("local errors", "local-errors", {"/time/end=200"});
        add("exponents", "henon-heiles",
            {"/time/end=400", "/observe/-=lyapunov-spectrum", "/observe/-=lyapunov"});
        add("order", "pendulum", {"/time/end=1000", "/observe/-=order"});
        add("events", "events", {"/time/end=2000", "/events/2/expression=t-1900"});
        add("sections", "poincare-section", {"/time/end=400"});
        add("rows from dense output", "pendulum",
            {"/time/end=60", "/output/every=0.01", "/output/dense=true"});
    }
    void aRunThatWasStoppedGoesOnToTheSameBytes() {
        QFETCH(QString, preset);
        QFETCH(QStringList, changes);
        std::vector<std::string> texts;
        for (const QString& change : changes) texts.push_back(change.toStdString());
        const Scene scene = sceneOf(preset.toStdString(), texts);
        const QTemporaryDir folders;
        const fs::path whole = folders.filePath("whole").toStdString();
        RunOptions plain;
        plain.threads = 1;
        plain.isTimed = false;
        const Files expected = exported(run(scene, plain), whole);
        // Elliptic problems are solved before their one march begins.
        const bool isAtOnce = preset == "elliptic" || preset == "free-knots";
        for (const double part : {0.2, 0.6}) {
            const fs::path stopped = folders.filePath(QString("stopped %1").arg(part)).toStdString();
            bool isPartial = runTo(scene, part, stopped, false);
            for (int again = 0; again < 20 && !isPartial && !isAtOnce; ++again)
                isPartial = runTo(scene, part, stopped, false);
            QVERIFY(isPartial || isAtOnce);
            runTo(scene, part + 0.2, stopped, true);  // and once more on the way
            Run rest(scene, often(stopped, true));
            QVERIFY(rest.hasCheckpoints() || isAtOnce);
            rest.start();
            rest.wait();
            rest.removeCheckpoints();
            const std::string off = difference(exported(rest.latest(), stopped), expected);
            QVERIFY2(off.empty(), off.c_str());
            for (const auto& entry : fs::directory_iterator(stopped))
                QVERIFY2(entry.path().extension() != ".checkpoint", entry.path().c_str());
        }
    }

    void aCheckpointOfAnotherSceneIsRefused() {
        const QTemporaryDir folders;
        const fs::path folder = folders.path().toStdString();
        const Scene scene = sceneOf("spring-pendulum", {"/time/end=20"});
        QVERIFY(runTo(scene, 0.3, folder, false));
        try {
            Run other(sceneOf("spring-pendulum", {"/time/end=21"}), often(folder, true));
            QFAIL("goes on with another scene");
        } catch (const InvalidScene& e) {
            QCOMPARE(e.problems().front().pointer, std::string("--resume"));
            QVERIFY(e.problems().front().message.find("belongs to another scene") != std::string::npos);
        }
        RunOptions newer = often(folder, true);
        newer.checkpoints->program = "a newer one";
        try {
            Run other(scene, newer);
            QFAIL("goes on with another program");
        } catch (const InvalidScene& e) {
            QVERIFY(e.problems().front().message.find("belongs to another program") != std::string::npos);
        }
        Run anew(scene, often(folder, false));  // which removes what is there
        QVERIFY(!anew.hasCheckpoints());
    }

    void aCheckpointThatIsNotWholeCountsAsMissing() {
        const QTemporaryDir folders;
        const fs::path folder = folders.path().toStdString();
        const Scene scene = sceneOf("kepler-sem", {"/time/end=200"});
        RunOptions plain;
        plain.isTimed = false;
        const Files expected = exported(run(scene, plain), folder);
        QVERIFY(runTo(scene, 0.3, folder, false));
        int damaged = 0;
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() != ".checkpoint") continue;
            const std::string bytes = contents(entry.path());
            std::ofstream(entry.path(), std::ios::binary) << bytes.substr(0, bytes.size() - 1);
            ++damaged;
        }
        QVERIFY(damaged > 0);
        Run again(scene, often(folder, true));
        again.start();
        again.wait();
        const std::string off = difference(exported(again.latest(), folder), expected);
        QVERIFY2(off.empty(), off.c_str());
    }

    void aFileThatCannotBeWrittenDoesNotEndTheRun() {
        const QTemporaryDir folders;
        const fs::path folder = folders.filePath("file").toStdString();
        std::ofstream(folder) << "in the way";
        Run blocked(sceneOf("kepler", {"/time/end=600"}), often(folder, false));
        blocked.start();
        blocked.wait();
        QVERIFY(!blocked.checkpointFailure().empty());
        for (const auto& scheme : blocked.latest().schemes) QCOMPARE(scheme->summary.status, RunStatus::done);
    }
};

EXTREMAL_TEST(CheckpointTest)

}  // namespace extremal::checkpoint_test

#include "checkpoint_test.moc"
