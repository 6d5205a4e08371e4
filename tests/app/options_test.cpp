// SPDX-License-Identifier: GPL-3.0-or-later
/// Every option of every verb is obeyed or refused: the test reads which there are from the program's own
/// help, so that a new option is in it by itself, and which verb takes which from the table of the parser.
#include <QDir>
#include <QDirIterator>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>

#include "app/option_table.hpp"
#include "engine/core/text/fingerprint.hpp"
#include "tests/app/program.hpp"
#include "tests/app/verb_calls.hpp"
#include "tests/tools/test.hpp"

namespace extremal::options_test {
namespace {

using app::optionTable;
using app::VerbOptions;

/// What a call leaves behind: exit code, words and files, without what the clock says.
struct Outcome {
    int code = -1;
    QString out, err;
    QMap<QString, QByteArray> files;
    bool operator==(const Outcome& other) const {
        return code == other.code && out == other.out && err == other.err && files == other.files;
    }
};

/// Two calls, of which the second has the option, and what both need beforehand. Their outcomes differ.
struct Sample {
    QStringList without, with;
    QList<QStringList> before = {};
};

const char* const sceneText = R"({"extremal": 1, "title": "two",
    "model": {"type": "pendulum"}, "initial": {"q": [1]}, "time": {"end": 2},
    "schemes": [{"label": "A", "scheme": "midpoint", "step": 0.1},
                {"label": "B", "scheme": "galerkin-gauss-2", "step": 0.2}],
    "observe": ["energy", "error"], "views": ["energy", "error"]})";

QString text(std::string_view view) {
    return QString::fromUtf8(view.data(), static_cast<qsizetype>(view.size()));
}

/// Options that the study of extremes has with a scene.
const QStringList& extremesOfScene() {
    static const QStringList all{"--set",   "--add",  "--trust",  "--x",     "--y",
                                 "--error", "--wish", "--metric", "--final", "--only"};
    return all;
}

/// A pair of calls for an option. An error that names the option shows as well that it was read.
Sample sampleOf(const QString& verb, const QString& option) {
    const QStringList needs = needsOf(verb);
    const auto added = [&](const QStringList& more, const QList<QStringList>& before = {}) {
        return Sample{needs, needs + more, before};
    };
    const auto replaced = [&](const QString& from, const QString& to) {
        if (!needs.contains(from)) return Sample{needs, needs + QStringList{option, to}};
        QStringList other = needs;
        other[other.indexOf(from)] = to;
        return Sample{needs, other};
    };
    if (option == "--out") {
        if (verb == "passport") return added(words("--out p.md"));
        if (verb == "formulas") return added(words("--out t.json"));
        if (verb == "snapshot") return replaced("p.png", "q.png");
        if (verb == "figure") return replaced("p.svg", "q.svg");
        if (verb == "page") return replaced("p.html", "q.html");
        if (verb == "program") return replaced("p.cpp", "q.cpp");
        return verb == "wisdom" ? replaced("w", "v") : replaced("d", "e");
    }
    if (verb == "orbit" && option == "--set") return added(words("--set /model/l=2"));
    if (verb == "orbit" && option == "--period") return replaced("2", "2.1");
    if (verb == "orbit" && QStringList{"--points", "--guess", "--starts"}.contains(option))
        return added({option, "6"});
    if (verb == "orbit" && option == "--manifold") return added({option, "unstable"});
    if (verb == "fit" && option == "--data") return replaced("m.csv", "missing.csv");
    if (verb == "motions" && option == "--starts") return replaced("m.csv", "missing.csv");
    if (verb == "fit" && option == "--free") return replaced("/model/l", "/model/g");
    if (verb == "program" && option == "--with") return added(words("--with /model/l"));
    if (verb == "gradient" && option == "--of") return replaced("theta", "p_theta");
    if (verb == "gradient" && option == "--over") return added(words("--over theta"));
    if (verb == "gradient" && option == "--with") return replaced("/model/l", "/model/g");
    if (verb == "steer" && option == "--set") return added(words("--set /time/end=1"));
    if (verb == "steer" && option == "--over") return replaced("u^2/2", "u^2");
    if (verb == "steer" && option == "--of") return added(words("--of p_x"));
    if (verb == "steer" && option == "--end") return replaced("x", "x-1");
    if (verb == "steer" && option == "--control") return added(words("--control v"));
    if (verb == "steer" && option == "--bounds") return added(words("--bounds u=1"));
    if (option == "--bias") return added({"--no-bias"});
    if (option == "--dpi")
        return {words("--view energy --out p.png"), words("--view energy --out p.png --dpi 100")};
    if (option == "--frames") return {words("--out p.html --frames 2"), words("--out p.html --frames 3")};
    if (option == "--measure") return {{"--measure"}, {"--no-measure"}};
    if (option == "--error" && verb == "study cheapest") return replaced("1e-2", "1e-3");
    if (option == "--error" && verb != "study extremes") return added(words("--error 1e-5"));
    if (verb == "study needs" && option == "--wish") return replaced("1e-2", "1e-3");
    if (verb == "study limits" && option == "--wish") return replaced("energy=1e-2", "energy=1e-3");
    if (verb == "study limits" && option == "--search-time") return replaced("100ms", "nonsense");
    if (verb == "study limits" && option == "--metric")
        return {words("--out d --search-time 100ms"), words("--out d --search-time 100ms --metric energy")};
    if (verb == "study extremes" && extremesOfScene().contains(option)) {
        const QStringList given = words("s.json --x /schemes/*/step=0.1:1:2 --metric energy --out d");
        const auto also = [&](const QString& more) { return Sample{given, given + words(more.toUtf8())}; };
        if (option == "--set") return also("--set /time/end=1");
        if (option == "--y") return also("--y /time/end=1:2:2");
        if (option == "--wish") return also("--wish energy=10");
        if (option == "--error") return also("--error 10");
        if (option == "--only") return also("--only B");
        if (option == "--final") return also("--final");
        if (option == "--add") return also("--add nowhere");
        if (option == "--trust") return Sample{given, given + QStringList{"--trust"}, {{"stranger"}}};
        QStringList other = given;
        if (option == "--x") other[2] = "/schemes/*/step=0.2:1:2";
        if (option == "--metric") other[4] = "error";
        return {given, other};
    }
    if (verb == "study needs" && option == "--candidates") return replaced("scene", "all");
    if (option == "--x") return replaced("/schemes/*/step=0.1:1:2", "/schemes/*/step=0.1:1:3");
    if (option == "--modes") return added(words("--modes 16"));
    if (option == "--points")
        return {needs + words("--from 0.2 --to 0.05"), needs + words("--from 0.2 --to 0.05 --points 3")};
    if (option == "--tolerance") {
        const QStringList compared = needs + words("--compare b.png");
        return {compared,
                compared + words("--tolerance 5"),
                {words("snapshot s.json --view energy --out b.png")}};
    }
    if (option == "--compare")
        return added(words("--compare b.png"), {words("snapshot s.json --view energy --out b.png")});
    if (option == "--set" && (verb == "check" || verb == "passport"))
        return added(words("--set /nonsense/key=1"));
    if (option == "--quiet" && (verb == "passport" || verb == "formulas"))
        return {needs + words("--out p.md"), needs + words("--out p.md --quiet")};
    if (option == "--trust") return added({"--trust"}, {{"stranger"}});
    if (option == "--force") {
        const QStringList full =
            verb == "passport" || verb == "formulas" ? needs + words("--out p.md") : needs;
        return {full, full + QStringList{"--force"}, {{"files of the user"}}};
    }
    if (option == "--resume") return added({"--resume"}, {{"log of another"}});
    if (option == "--shard" && verb == "study extremes") return {needs, needs + words("--shard nonsense")};
    if (option == "--size") return added(words("--size 640x480"));
    static const QMap<QString, QStringList> simple{
        {"--set", words("--set /time/end=1")},
        {"--add", words("--add missing")},
        {"--json", words("--json")},
        {"--quiet", words("--quiet")},
        {"--threads", words("--threads 0")},
        {"--equations", words("--equations tex")},
        {"--checkpoint", words("--checkpoint nan")},
        {"--view", words("--view error")},
        {"--time", words("--time 1")},
        {"--width", words("--width page")},
        {"--ratio", words("--ratio 0.5")},
        {"--letters", words("--letters 9")},
        {"--lines", words("--lines 2")},
        {"--columns", words("--columns 2")},
        {"--font", words("--font missing")},
        {"--legend", words("--legend none")},
        {"--colours", words("--colours grey")},
        {"--portraits", words("--portraits over")},
        {"--titles", words("--no-titles")},
        {"--equal", words("--equal")},
        {"--times", words("--times 0:1")},
        {"--caption", words("--caption mine")},
        {"--draw-caption", words("--draw-caption")},
        {"--scheme", words("--scheme B")},
        {"--energy", words("--energy -6")},
        {"--hold", words("--hold period")},
        {"--follow", words("--follow energy=-8")},
        {"--columns", words("--columns theta")},
        {"--format", words("--format tex")},
        {"--language", words("--language python")},
        {"--metric", words("--metric energy")},
        {"--final", words("--final")},
        {"--repeat", words("--repeat -1")},
        {"--budget", words("--budget 1ms")},
        {"--memory", words("--memory 1kB")},
        {"--wish", words("--wish energy=1e-5")},
        {"--candidates", words("--candidates all")},
        {"--search-time", words("--search-time soon")},
        {"--knobs", words("--knobs colour")},
        {"--over", words("--over /model/l=1,1.5")},
        {"--of", words("--of mean")},
        {"--steps", words("--steps 0.2,0.1")},
        {"--from", words("--from 0.2 --to 0.1")},
        {"--to", words("--from 0.2 --to 0.1")},
        {"--y", words("--y /model/l=1:2:2")},
        {"--limit", words("--limit")},
        {"--only", words("--only A")},
        {"--shard", words("--shard 1/2")},
        {"--plot", words("--no-plot")},
        {"--systems", words("--systems missing")},
        {"--version", words("--version")},
        {"--verbose", words("--verbose")},
        // Their runs take minutes: tests/extremes and atlas_test.cpp.
        {"--long", {}},
        {"--quick", {}},
    };
    const auto found = simple.constFind(option);
    if (found == simple.constEnd()) return {{"no sample"}, {"no sample"}};
    if (found->isEmpty()) return {};
    if (option == "--verbose") return {{"--version"}, {"--version", "--verbose"}};
    return added(*found);
}

QByteArray withoutClock(QByteArray bytes, const QString& name) {
    if (name.endsWith("summary.csv")) {
        QByteArrayList lines = bytes.split('\n');
        for (QByteArray& line : lines) {
            QByteArrayList cells = line.split(',');
            if (cells.size() > 10) cells[10].clear();
            line = cells.join(',');
        }
        return lines.join('\n');
    }
    static const QRegularExpression clock(QStringLiteral("\"cpu_seconds\": [^,]*|[0-9.e+-]+ (µs|ms|s)\\b"));
    if (name.endsWith(".json")) return QString::fromUtf8(bytes).remove(clock).toUtf8();
    return bytes;
}

/// Names of options in a text of help: "--plot" of "--plot,--no-plot{false}".
QStringList optionsIn(const QString& help) {
    static const QRegularExpression line(QStringLiteral(R"(^ +(?:-\w,)?(--[\w-]+))"),
                                         QRegularExpression::MultilineOption);
    QStringList all;
    const QString own = help.left(help.indexOf("Examples:"));
    for (const QRegularExpressionMatch& match : line.globalMatch(own)) all << match.captured(1);
    all.removeAll("--help");
    return all;
}

/// The program in an empty folder of its own that has the scene, and what the sample needs beforehand.
class Call {
public:
    explicit Call(const Sample& sample) {
        write("s.json", sceneText);
        write("m.csv", "t,theta,p.theta\n0.1,0.9,0\n0.3,0.7,-1\n0.6,0.1,-2\n0.9,-0.5,-2\n");
        for (const QStringList& before : sample.before) prepare(before);
    }

    Outcome outcome(const QStringList& arguments) {
        Outcome result;
        run(arguments, result);
        for (QDirIterator all(folder_.path(), QDir::Files | QDir::Hidden, QDirIterator::Subdirectories);
             all.hasNext();) {
            const QString file = all.next(), name = QDir(folder_.path()).relativeFilePath(file);
            // A log says what was asked for, obeyed or not.
            if (!name.endsWith(".log")) result.files[name] = withoutClock(tests::contentOf(file), name);
        }
        return result;
    }

private:
    void write(const QString& name, const QByteArray& bytes) {
        QFile file(folder_.filePath(name));
        QVERIFY(file.open(QIODevice::WriteOnly));
        QCOMPARE(file.write(bytes), bytes.size());
    }
    void prepare(const QStringList& what) {
        if (what == QStringList{"stranger"}) {
            QVERIFY(outside_.isValid());
            QFile file(outside_.filePath("o.csv"));
            QVERIFY(file.open(QIODevice::WriteOnly));
            // The motion itself, so that searches for an error end.
            file.write("t,q.theta,p.theta\n0,1,0\n2,0.9207938271559717,1.1283018575016748\n");
            const QByteArray reference = "\"reference\": {\"type\": \"file\", \"path\": \"" +
                                         outside_.filePath("o.csv").toUtf8() + "\"}, ";
            write("s.json", QByteArray(sceneText).replace("\"title\"", reference + "\"title\""));
        } else if (what == QStringList{"log of another"}) {
            // Of another study, and of another scene.
            const std::string head = R"({ "extremal": 1, "study": "other", "scene": "0" })";
            const QByteArray log = QByteArray::fromStdString(head + ' ' + checksum(head) + '\n');
            QVERIFY(QDir(folder_.path()).mkdir("d"));
            for (const char* study : {"convergence", "work-precision", "cheapest", "needs", "stability",
                                      "linear-stability", "limits", "extremes", "harmonic-oscillator.error"})
                write(QString("d/%1.log").arg(study), log);
            for (const char* slug : {"a", "b"})
                write(QString("d/%1.checkpoint").arg(slug), "{ \"extremal\": 1, \"scene\": \"0\" }\n0\n");
        } else if (what == QStringList{"files of the user"}) {
            QVERIFY(QDir(folder_.path()).mkdir("d"));
            for (const char* name : {"d/scene.json", "d/index.html", "d/extremes.csv", "d/gradient.csv",
                                     "p.png", "p.svg", "p.html", "p.cpp", "p.md"})
                write(name, "mine\n");
        } else {
            Outcome ignored;
            run(what, ignored);
            QCOMPARE(ignored.code, 0);
        }
    }
    void run(const QStringList& arguments, Outcome& result) {
        QProcess process;
        process.setWorkingDirectory(folder_.path());
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) environment.remove(name);
        process.setProcessEnvironment(environment);
        process.start(QStringLiteral(EXTREMAL_BINARY), arguments);
        QVERIFY(process.waitForFinished(tests::limit(60000)));
        result.code = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2;
        result.out = QString::fromUtf8(withoutClock(process.readAllStandardOutput(), ".json"));
        result.err = QString::fromUtf8(process.readAllStandardError());
    }

    QTemporaryDir folder_, outside_;
};

}  // namespace

class OptionsTest : public QObject {
    Q_OBJECT
private slots:
    /// The table has the verbs, studies and options of the program, and no others.
    void theTableIsThatOfTheProgram() {
        QMap<QString, QStringList> rows;
        for (const VerbOptions& row : optionTable()) {
            const QString verb = text(row.verb).section(' ', 0, 0);
            for (const std::string_view option : row.options)
                if (!rows[verb].contains(text(option))) rows[verb] << text(option);
            rows[verb].sort();
        }
        QStringList verbs{""};
        const QString help = tests::runProgram({"--help"}).out;
        static const QRegularExpression verbLine(QStringLiteral("^  ([a-z]+) "),
                                                 QRegularExpression::MultilineOption);
        for (const auto& match :
             verbLine.globalMatch(help.left(help.indexOf("Examples:")).mid(help.indexOf("VERB]"))))
            verbs << match.captured(1);
        verbs.removeDuplicates();
        verbs.sort();
        QCOMPARE(rows.keys(), verbs);
        for (const QString& verb : verbs) {
            QStringList options = optionsIn(verb.isEmpty() ? help : tests::runProgram({verb, "--help"}).out);
            if (verb.isEmpty())  // those of verbs may stand before a verb
                for (const QString& option : QStringList(options))
                    if (!rows[verb].contains(option) && app::takes("run", option.toStdString()))
                        options.removeAll(option);
            options.sort();
            QCOMPARE(options, rows[verb]);
        }
        QStringList studies;
        for (const QString& line : tests::runProgram({"list", "studies"}).out.split('\n', Qt::SkipEmptyParts))
            studies << "study " + line.section(' ', 0, 0);
        for (const VerbOptions& row : optionTable())
            if (row.verb.starts_with("study ") && row.verb != "study merge")
                QCOMPARE(studies.removeAll(text(row.verb)), 1);
        QCOMPARE(studies, QStringList());
    }

    void anOptionThatIsTakenChangesTheResult_data() {
        QTest::addColumn<QString>("verb");
        QTest::addColumn<QString>("option");
        for (const VerbOptions& row : optionTable())
            for (const std::string_view option : row.options)
                QTest::newRow((std::string(row.verb) + " " + std::string(option)).c_str())
                    << text(row.verb) << text(option);
    }
    void anOptionThatIsTakenChangesTheResult() {
        QFETCH(QString, verb);
        QFETCH(QString, option);
        Sample sample = sampleOf(verb, option);
        QVERIFY2(sample.with != QStringList{"no sample"}, "a new option needs a sample in this test");
        if (sample.with.isEmpty()) return;
        if (verb == "study merge")
            for (const char* part : {"1/2", "2/2"})
                sample.before << words("study convergence s.json --no-plot --repeat 0 --shard") +
                                     QStringList{part, "--out", *part == '1' ? "one" : "two"};
        const Outcome without = Call(sample).outcome(callOf(verb) + sample.without);
        const Outcome with = Call(sample).outcome(callOf(verb) + sample.with);
        const int expected = option == "--trust" || verb.isEmpty() ? 2 : option == "--force" ? 3 : 0;
        QVERIFY2(without.code == expected || option == "--verbose", qPrintable(without.err));
        // A file of another model was read, and does not fit.
        const bool isTrusted = option == "--trust" && (with.code == 1 || with.err.contains("has no column"));
        QVERIFY2(with.code == 0 || with.err.contains(option) || isTrusted, qPrintable(with.err));
        QVERIFY(!(with == without));
        if (with.code != 0) return;
        for (const QString& line : QString(with.err).split('\n'))  // of the scene there may be warnings
            QVERIFY2(!line.startsWith("extremal: ") || line.contains(": warning: "), qPrintable(with.err));
    }

    void anOptionThatIsNotTakenIsRefused_data() {
        QTest::addColumn<QString>("verb");
        for (const VerbOptions& row : optionTable())
            QTest::newRow(std::string(row.verb).c_str()) << text(row.verb);
    }
    void anOptionThatIsNotTakenIsRefused() {
        QFETCH(QString, verb);
        QStringList all, own;
        for (const VerbOptions& row : optionTable())
            for (const std::string_view option : row.options) {
                if (!all.contains(text(option))) all << text(option);
                if (row.verb == verb.toStdString()) own << text(option);
            }
        Call call({});
        for (const QString& option : all) {
            if (own.contains(option)) continue;
            // What no study has is refused before the kind of the study is looked at: once will do.
            const bool isOfNoStudy = verb.startsWith("study ") && !app::takes("study", option.toStdString());
            if (isOfNoStudy && verb != "study convergence") continue;
            QStringList given = sampleOf("study convergence", option).with;
            given = given.contains(option) ? given.mid(given.indexOf(option)) : QStringList{option};
            if (option == "--from" || option == "--to") given = {option, "0.1"};
            if (option == "--modes") given = {option, "8"};
            const Outcome result = call.outcome(callOf(verb) + needsOf(verb) + given);
            const QString said = option + ": " + QString::number(result.code) + " " + result.err;
            QVERIFY2(result.code == 2, qPrintable(said));
            QVERIFY2(result.err.contains(option), qPrintable(said));
            QVERIFY2(result.files.keys() == QStringList({"m.csv", "s.json"}), qPrintable(said));
        }
        // Before the verb as well.
        if (!own.contains("--set") && !verb.isEmpty())
            QCOMPARE(call.outcome(words("--set /nonsense/key=1") + callOf(verb) + needsOf(verb)).code, 2);
    }

    /// A second call replaces what the first one wrote, and so does a call of another scene. (A scene in a
    /// file of a name of its own, as `formulas` writes it, belongs to the user.)
    void ownFilesAreReplaced_data() {
        QTest::addColumn<QString>("verb");
        for (const app::VerbOptions& row : app::optionTable())
            if (has(row, "--out") && has(row, "--set") && !row.verb.starts_with("study") &&
                row.verb != "formulas")
                QTest::newRow(std::string(row.verb).c_str()) << text(row.verb);
    }
    void ownFilesAreReplaced() {
        QFETCH(QString, verb);
        const QStringList given = callOf(verb) + sampleOf(verb, "--out").with;
        Call call({});
        for (const QStringList& more : {QStringList(), QStringList(), words("--set /time/end=1")}) {
            const Outcome result = call.outcome(given + more);
            QVERIFY2(result.code == 0, qPrintable(result.err));
        }
    }

    void whatHasNoMeaningIsRefused_data() {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* arguments, const char* said) {
            QTest::newRow(arguments) << words(arguments) << QString(said);
        };
        row("study extremes nowhere.json --shard 1/1000 --out d", "takes no SCENE");
        row("study extremes s.json --shard 1/1000 --out d", "takes no SCENE");
        row("study merge --out d", "needs the folders of the shards");
        row("study convergence s.json --steps 0.1 --from 0.2 --to 0.1 --out d", "--steps");
        row("study convergence s.json --from 0.2 --out d", "--to");
        row("study convergence s.json --points 3 --out d", "--points");
        row("study convergence s.json --from nan --to 0.1 --out d", "--from");
        row("study convergence s.json --steps 0.1,inf --out d", "--steps");
        row("study cheapest s.json --error nan --out d", "--error");
        row("study needs s.json --error nan --out d", "--error");
        row("study limits s.json --error -1 --out d", "--error");
        row("study extremes s.json --x /model/l=1:2:2 --error nan --out d", "--error");
        row("run s.json --checkpoint nan --out d", "--checkpoint");
        row("run s.json --checkpoint -1 --out d", "--checkpoint");
        row("run s.json --checkpoint inf --out d", "--checkpoint");
        row("snapshot s.json --out p.png --time nan", "--time");
        row("snapshot s.json --out p.png --compare b.png --tolerance nan", "--tolerance");
        row("snapshot s.json --out p.png --tolerance 1", "--compare");
        row("snapshot s.json --out p.jpg", ".png, .pdf or .svg");
        row("passport s.json --no-measure --out p.txt", "not that of a format");
        row("passport s.json --no-measure --out p", "not that of a format");
        row("program s.json --out p.f90", "not that of a format");
        row("program s.json --out md", "not that of a format");
        row("--version run s.json --out d", "--version");
        row("--version s.json", "--version");
        row("s.json list views", "a scene before list");
        row("--trust s.json", "--trust: is not an option of the window");
    }
    void whatHasNoMeaningIsRefused() {
        QFETCH(QStringList, arguments);
        QFETCH(QString, said);
        const Outcome result = Call({}).outcome(arguments);
        QVERIFY2(result.code == 2, qPrintable(result.err));
        QVERIFY2(result.err.contains(said), qPrintable(result.err));
        QCOMPARE(result.files.keys(), QStringList({"m.csv", "s.json"}));
    }
};

EXTREMAL_TEST(OptionsTest)

}  // namespace extremal::options_test

#include "options_test.moc"
