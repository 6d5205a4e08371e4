// SPDX-License-Identifier: GPL-3.0-or-later
/// Fuzzing of the command line: `tool.calls COUNT [SEED [FIRST]]`. Every call is a verb with its options and
/// others, some of their values hostile, on a scene, a fuzzed one or something that is none, in a temporary
/// folder. A call must end by itself, or within ten seconds of being asked to after twenty, with an exit
/// code of the handbook's (0 to 3, 130), say what is wrong where the code is 2 or 3, and leave the files that
/// it was given alone. Prints what did not, and the counts; ends with 1 if anything was found.
#include <QCoreApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QMap>
#include <QProcess>
#include <QTemporaryDir>

#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "app/option_table.hpp"
#include "engine/scene/preset.hpp"
#include "tests/app/program.hpp"
#include "tests/app/verb_calls.hpp"
#include "tests/fuzz/kinds.hpp"
#include "tests/fuzz/mutation.hpp"

namespace extremal::fuzz {
namespace {

constexpr int patience = 20'000, graceful = 10'000;

QString oneOf(Random& random, const char* words) { return random.of(QString(words).split(' ')); }

class Calls {
public:
    explicit Calls(std::uint64_t seed) : seed_(seed) { QDir::setCurrent(folder_.path()); }

    void one(std::uint64_t number) {
        Random random(seed_, number);
        prepare(random);
        const QStringList call = make(random);
        QElapsedTimer clock;
        clock.start();
        QProcess process;
        process.start(QStringLiteral(EXTREMAL_BINARY), call);
        process.closeWriteChannel();
        QString fault;
        bool isAsked = false;
        if (!process.waitForFinished(patience)) {
            isAsked = true;
            process.terminate();
            if (!process.waitForFinished(graceful)) {
                fault = "does not end";
                process.kill();
                process.waitForFinished();
            }
        }
        const QString said = process.readAllStandardError() + process.readAllStandardOutput();
        if (fault.isEmpty()) fault = faultOf(process, said, isAsked);
        ++codes_[process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -1];
        if (isAsked) ++asked_;
        if (clock.elapsed() > slowest_ && !isAsked) {
            slowest_ = clock.elapsed();
            slowestNumber_ = number;
        }
        for (auto it = given_.cbegin(); it != given_.cend() && fault.isEmpty(); ++it)
            if (tests::contentOf(it.key()) != it.value()) fault = "changed " + it.key();
        if (fault.isEmpty()) return;
        ++faults_;
        std::printf("%llu: %s\n    extremal %s\n    %s\n", static_cast<unsigned long long>(number),
                    qPrintable(fault), qPrintable(call.join(" | ").left(600)),
                    qPrintable(said.left(400).replace('\n', "\n    ")));
        std::fflush(stdout);
    }
    bool report(std::uint64_t count) const {
        std::printf(
            "%llu calls, %d faults, %d stopped after %d s; slowest of the others %.1f s (%llu); codes",
            static_cast<unsigned long long>(count), faults_, asked_, patience / 1000,
            static_cast<double>(slowest_) / 1000, static_cast<unsigned long long>(slowestNumber_));
        for (auto it = codes_.cbegin(); it != codes_.cend(); ++it)
            std::printf(" %d: %d", it.key(), it.value());
        std::printf("\n");
        return faults_ == 0;
    }

private:
    void give(const QString& name, const QByteArray& content) {
        QFile file(name);
        if (file.open(QIODevice::WriteOnly)) file.write(content);
        given_[name] = content;
    }
    /// A fresh folder, now and then with what an earlier call has left.
    void prepare(Random& random) {
        if (!random.oneIn(5)) {
            for (const QFileInfo& entry :
                 QDir().entryInfoList(QDir::AllEntries | QDir::NoDotAndDotDot | QDir::Hidden)) {
                if (entry.isDir() && !entry.isSymLink())
                    QDir(entry.filePath()).removeRecursively();
                else
                    QFile::remove(entry.filePath());
            }
        }
        given_.clear();
        const auto bytes = [](const std::string& text) {
            return QByteArray(text.data(), static_cast<qsizetype>(text.size()));
        };
        give("s.json", R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1], "p": [0]},
                          "time": {"end": 1}, "schemes": [{"scheme": "galerkin-gauss-2", "step": 0.1},
                          {"baseline": "rk4", "step": 0.1}]})");
        give("fuzzed.json", bytes(makeCase(kinds()[random.below(2)], seed_, random.next())));
        give("m.csv", bytes(makeCase(kinds().back(), seed_, random.next())));
    }
    QString scene(Random& random) {
        if (random.oneIn(3)) return "s.json";
        if (!random.oneIn(3)) return "fuzzed.json";
        if (random.oneIn(3)) return "preset:" + QString::fromStdString(std::string(random.of(presets()).id));
        return oneOf(random, "missing.json . / /dev/null m.csv preset: preset:none - --out s.json/");
    }
    QString value(Random& random) {
        switch (random.below(6)) {
            case 0:
                return oneOf(random,
                             "1 2 0 -1 0.1 1e-3 1e400 nan inf -0 1e-320 99999999999999999999 1/0 0x10");
            case 1:
                return oneOf(random,
                             "d out p.png p.svg p.html s.json m.csv . .. /proc/none /dev/null /dev/full "
                             "missing/deep/file.csv d/../d nul");
            case 2:
                return oneOf(random,
                             "theta energy error order theta^2 q.theta phase 1:2 1/2 2/1 0/0 a,b , "
                             "energy=1e-2 10ms 1us/s 800x600 0x0 1x1 -1x5");
            case 3: {
                const Value some = hostileValue(random);
                return QString::fromStdString(some.isString() ? some.asString() : std::string("0"))
                    .remove(QChar(0));
            }
            case 4:
                return oneOf(random,
                             "/model/l=2 /schemes/*/step=0.1:1:3 /initial/q/0=nan /time/end=0.2 "
                             "/views/-=energy /model={} /schemes=[] =1 /a~2b=1 /model/l");
            default:
                return QString::fromStdString(formula(random, {"theta", "p", "t"}, 2));
        }
    }
    QStringList make(Random& random) {
        using namespace options_test;
        const auto& table = app::optionTable();
        const app::VerbOptions& row = random.of(table);
        const QString verb = QString::fromUtf8(row.verb.data(), static_cast<qsizetype>(row.verb.size()));
        if (verb.isEmpty()) return {"--version", value(random)};  // else it is the window
        QStringList call = callOf(verb);
        call.replaceInStrings("s.json", scene(random));
        if (!random.oneIn(16)) call += needsOf(verb);
        if (random.oneIn(3)) return call;  // what is wrong is in the scene, if anything
        for (std::size_t k = random.below(4); k > 0; --k) {
            const auto& options = random.oneIn(10) ? random.of(table).options : row.options;
            if (options.empty()) continue;
            call << QString::fromStdString(std::string(random.of(options)));
            if (!random.oneIn(4)) call << value(random);
        }
        if (random.oneIn(12) && call.size() > 1)
            call.removeAt(static_cast<qsizetype>(random.below(std::size_t(call.size()))));
        if (random.oneIn(12)) call << random.of(call);
        if (random.oneIn(20)) call.insert(1, value(random));
        return call;
    }
    static QString faultOf(const QProcess& process, const QString& said, bool isAsked) {
        // The window ends by the signal that asks it to, after it has kept its edits.
        if (isAsked && process.exitStatus() != QProcess::NormalExit && process.exitCode() == SIGTERM)
            return {};
        if (process.exitStatus() != QProcess::NormalExit) return "is ended by a signal";
        const int code = process.exitCode();
        if ((code < 0 || code > 3) && !(isAsked && (code == 130 || code == 143)))
            return QString("has exit code %1").arg(code);
        if (said.contains("internal error") || said.contains("terminate called"))
            return "says internal error";
        if ((code == 2 || code == 3) && said.trimmed().isEmpty()) return "refuses without a word";
        return {};
    }

    std::uint64_t seed_;
    QTemporaryDir folder_;
    QMap<QString, QByteArray> given_;
    QMap<int, int> codes_;
    int faults_ = 0, asked_ = 0;
    qint64 slowest_ = 0;
    std::uint64_t slowestNumber_ = 0;
};

}  // namespace
}  // namespace extremal::fuzz

int main(int argc, char** argv) {
    QCoreApplication application(argc, argv);
    const QStringList words = application.arguments();
    const auto number = [&](qsizetype i, std::uint64_t otherwise) {
        return words.size() > i ? words[i].toULongLong() : otherwise;
    };
    const std::uint64_t count = number(1, 100), first = number(3, 0);
    extremal::fuzz::Calls calls(number(2, 1));
    for (std::uint64_t k = first; k < first + count; ++k) calls.one(k);
    return calls.report(count) ? 0 : 1;
}
