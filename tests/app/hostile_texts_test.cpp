// SPDX-License-Identifier: GPL-3.0-or-later
/// Texts of a scene in everything that is exported: whatever a title, a label, a note or a formula says, a
/// strict reader finds in the file what it finds in that of a harmless scene, and nothing that acts.
#include <QDir>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBlock>
#include <QTextDocument>
#include <QTextTable>
#include <QXmlStreamReader>

#include "engine/core/text/text.hpp"
#include "engine/figure/build.hpp"
#include "engine/figure/image/svg.hpp"
#include "engine/passport/passport.hpp"
#include "engine/passport/program.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"
#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"
#include "ui/pictures/export_folder.hpp"
#include "ui/pictures/playing_page.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::hostile_texts_test {
namespace {

using namespace std::string_literals;
using tests::contentOf;

/// What a text can be made of to end the place it stands in. Those with control characters no scene can have;
/// exporters are given them all the same.
const std::vector<std::pair<const char*, std::string>>& hostileTexts() {
    static const std::vector<std::pair<const char*, std::string>> all{
        {"cookie", "coding=raw_unicode_escape \\u000aimport os#"},
        {"cookie in words", "Decoding: the pendulum"},
        {"line feed", "a\nimport os\n#error"},
        {"carriage return", "a\rimport os"},
        {"both", "a\r\nint evil;\r\n"},
        {"form feed", "a\fimport os\v#error"},
        {"U+0085", "a\u0085import os"},
        {"U+2028", "a\u2028import os"},
        {"U+2029", "a\u2029import os"},
        {"end of comment", "*/ int evil; /*"},
        {"backslash", "a\\"},
        {"backslash and spaces", "a\\  "},
        {"trigraph", "a?\?/"},
        {"trigraph of a line", "a?\?/ "},
        {"quotes", "'\"; import os; '''\"\"\""},
        {"named character", "\\N{LINE FEED}import os \\x0a \\u000a \\12"},
        {"zero", "a\0b"s},
        {"bell and escape", "a\a\x1b[2Jb\x7f"},
        {"CDATA", "a]]>b<![CDATA["},
        {"end of a comment in XML", "a-->b<!--"},
        {"script", "</title></desc><script>alert(1)</script>"},
        {"attribute", "\" onload=\"alert(1)\" x='"},
        {"ampersand", "A & B &lt; &#60;script> &nbsp;"},
        {"link", "[x](javascript:alert(1)) ![y](http://127.0.0.1/x.png) [z]: javascript:alert(1)"},
        {"link by reference", "[x][y] [y]: javascript:alert(1) <javascript:alert(1)>"},
        {"tags in Markdown", "<img src=http://127.0.0.1/x.png onerror=alert(1)> <iframe src=/etc/passwd>"},
        {"table", "a | b | c"},
        {"fence", "``` x ```"},
        {"heading", "# a"},
        {"TeX", "\\input{/etc/passwd} \\write18{id} $x$ % \\end{document}"},
        {"TeX in an index", "x_{\\input{/etc/passwd}} y^(\\write18)"},
        {"end of verbatim", "\\end{verbatim} \\end{gather*}"},
        {"direction", "a\u202e\u2066b\u2069"},
        {"noncharacters", "a\ufffe\uffff"},
        {"not UTF-8", "a\xff\xc0\xaf"},
        {"places of arguments", "%1 %2 %3 %4 %9"},
        {"commas", "a,\"b\"\n,c"},
    };
    return all;
}

constexpr const char* harmless = "plain";

const char* const sceneText = R"({"extremal": 1, "title": "plain", "source": "plain", "lesson": "plain",
    "notes": "plain",
    "model": {"type": "lagrangian", "coordinates": ["x"], "lagrangian": "x_t^2/2 - x^2/2"},
    "initial": {"q": [1]}, "time": {"end": 1},
    "schemes": [{"label": "plain", "scheme": "galerkin-gauss-2", "step": 0.1}],
    "events": [{"label": "plain", "expression": "x - 0.9"}],
    "observe": ["energy"], "views": ["energy", "trajectory"]})";

/// A scene and the results of its run that say `text` wherever a scene has words of its own.
struct Sample {
    ResolvedScene resolved;
    ExportParts parts;
};

Sample sampleWith(const std::string& text) {
    static const ReadScene read = readScene(parseJson(sceneText));
    static const Comparison result = [] {
        Run run(read.scene);
        run.start();
        run.wait();
        return run.latest();
    }();
    Sample sample{*read.resolved, {}};
    const auto say = [&](Scene& scene) {
        scene.title = scene.source = scene.lesson = scene.notes = text;
        scene.events.front().label = text;
        for (SchemeSpec& scheme : scene.schemes) scheme.label = text;
    };
    say(sample.resolved.scene);
    for (ResolvedScheme& scheme : sample.resolved.schemes) scheme.spec.label = text;
    Comparison comparison = result;
    say(comparison.scene);
    for (auto& scheme : comparison.schemes) {
        auto changed = std::make_shared<SchemeResult>(*scheme);
        changed->spec.label = changed->summary.label = text;
        scheme = changed;
    }
    sample.parts.comparison = std::make_shared<const Comparison>(std::move(comparison));
    for (const View& view : plotViews(sample.parts.comparison->scene)) {
        sample.parts.figures.push_back(
            makeFigure(*sample.parts.comparison, view, sample.parts.comparison->system.get()));
        Figure& figure = sample.parts.figures.back();
        figure.title = figure.subtitle = figure.summary = text;
    }
    return sample;
}

QByteArray bytes(const std::string& text) { return QByteArray::fromStdString(text); }

QByteArray outputOf(const QString& program, const QStringList& arguments, int& code) {
    QProcess process;
    process.setProcessChannelMode(QProcess::MergedChannels);
    process.start(program, arguments);
    if (!process.waitForFinished(tests::limit(60000))) return {};
    code = process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2;
    return process.readAll();
}

void write(const QString& path, const QByteArray& text) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(text), text.size());
}

/// Names of elements in their order; "error: ..." of what is not XML.
QStringList elementsOf(const QByteArray& xml, QStringList* texts = nullptr) {
    QXmlStreamReader reader(xml);
    QStringList names;
    while (!reader.atEnd()) {
        const auto token = reader.readNext();
        if (token == QXmlStreamReader::Characters && texts) *texts << reader.text().toString();
        if (token == QXmlStreamReader::ProcessingInstruction || token == QXmlStreamReader::EntityReference)
            names << QStringLiteral("error: not plain");
        if (token != QXmlStreamReader::StartElement) continue;
        names << reader.name().toString();
        for (const QXmlStreamAttribute& attribute : reader.attributes())
            if (attribute.name().startsWith(QLatin1String("on")) ||
                (attribute.name() == QLatin1String("href") && !attribute.value().startsWith('#') &&
                 !attribute.value().startsWith(QLatin1String("data:"))))
                names << QStringLiteral("error: ") + attribute.name().toString();
    }
    if (reader.hasError()) names << QStringLiteral("error: ") + reader.errorString();
    return names;
}

QStringList tagsOf(const QString& html) {
    static const QRegularExpression tag(QStringLiteral("<[^>]*>"));
    QStringList tags;
    for (const QRegularExpressionMatch& match : tag.globalMatch(html)) tags << match.captured(0);
    return tags;
}

/// A document that notes what it is asked to load.
class WatchedDocument : public QTextDocument {
public:
    QStringList asked;

private:
    QVariant loadResource(int, const QUrl& name) override {
        asked << name.toString();
        return {};
    }
};

/// Blocks, their kinds, cells of tables, and what is active.
QStringList structureOf(const QString& markdown) {
    WatchedDocument document;
    document.setMarkdown(markdown);
    QStringList parts;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        parts << QStringLiteral("block %1 %2")
                     .arg(block.blockFormat().headingLevel())
                     .arg(block.blockFormat().hasProperty(QTextFormat::BlockCodeFence));
        for (auto each = block.begin(); !each.atEnd(); ++each) {
            const QTextCharFormat format = each.fragment().charFormat();
            if (format.isImageFormat()) parts << QStringLiteral("image");
            if (format.isAnchor() && !format.anchorHref().startsWith(QLatin1String("http")))
                parts << QStringLiteral("link ") + format.anchorHref();
        }
    }
    for (const QString& each : document.asked) parts << QStringLiteral("asked for ") + each;
    return parts;
}

/// Commands of TeX, each once.
QStringList commandsOf(const QString& tex) {
    static const QRegularExpression command(QStringLiteral(R"(\\([A-Za-z]+|.))"));
    QStringList all;
    for (const QRegularExpressionMatch& match : command.globalMatch(tex)) all << match.captured(0);
    all.removeDuplicates();
    return all;
}

/// RFC 4180 to the letter: cells by row; empty where it is not.
std::vector<std::vector<std::string>> rowsOf(const std::string& csv) {
    std::vector<std::vector<std::string>> rows{{""}};
    for (std::size_t i = 0; i < csv.size(); ++i) {
        std::string& cell = rows.back().back();
        if (csv[i] == ',') {
            rows.back().emplace_back();
        } else if (csv[i] == '\n') {
            if (i + 1 < csv.size()) rows.push_back({""});
        } else if (csv[i] == '"') {
            if (!cell.empty()) return {};
            for (++i; i < csv.size() && (csv[i] != '"' || (i + 1 < csv.size() && csv[i + 1] == '"')); ++i) {
                cell += csv[i];
                if (csv[i] == '"') ++i;
            }
            if (i + 1 < csv.size() && csv[i + 1] != ',' && csv[i + 1] != '\n') return {};
        } else if (csv[i] == '\r') {
            return {};
        } else {
            cell += csv[i];
        }
    }
    return rows;
}

}  // namespace

class HostileTextsTest : public QObject {
    Q_OBJECT
private slots:
    /// One process reads all programs: a tree that differs from that of the harmless one is foreign code.
    void programsInPythonHaveTheSameTree() {
        QStringList files{at("plain.py")};
        write(files[0], pythonOf(harmless));
        for (const auto& [name, text] : hostileTexts()) {
            files << at(QString("h%1.py").arg(files.size()));
            write(files.back(), pythonOf(text));
        }
        write(at("read.py"),
              "import ast, sys, tokenize\n"
              "trees = []\n"
              "for name in sys.argv[1:]:\n"
              "    source = open(name, 'rb').read()\n"
              "    assert tokenize.detect_encoding(iter(source.splitlines(True)).__next__)[0] == 'utf-8', "
              "name\n"
              "    trees.append(ast.dump(compile(source, name, 'exec', ast.PyCF_ONLY_AST)))\n"
              "    assert trees[-1] == trees[0], name\n"
              "    assert all(c.isprintable() or c == '\\n' for c in source.decode('utf-8')), name\n");
        int code = -1;
        const QByteArray said = outputOf(EXTREMAL_PYTHON, QStringList{at("read.py")} + files, code);
        QVERIFY2(code == 0, said);
    }

    /// Without comments, and with lines put together as the oldest standard does, the text is the same.
    void programsInCppHaveTheSameText() {
        const auto plainText = [&](const std::string& text) {
            write(at("p.cpp"), cppOf(text));
            int code = -1;
            const QByteArray out = outputOf(
                "g++",
                {"-std=c++11", "-trigraphs", "-Wall", "-Werror", "-E", "-P", "-fpreprocessed", at("p.cpp")},
                code);
            return code == 0 ? out : "error: " + out;
        };
        const QByteArray plain = plainText(harmless);
        QVERIFY(plain.contains("int main"));
        for (const auto& [name, text] : hostileTexts()) QVERIFY2(plainText(text) == plain, name);
        std::string all;
        for (const auto& [name, text] : hostileTexts()) all += text;
        write(at("all.cpp"), cppOf(all));
        int code = -1;
        const QByteArray said = outputOf(
            "g++", {"-std=c++17", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", at("all.cpp")}, code);
        QVERIFY2(code == 0, said);
    }

    /// Line ends and tabs are blanks of a formula, and of nothing else.
    void formulasOfTwoLinesArePrograms() {
        const QString out = at("formula.py"), cpp = at("formula.cpp");
        for (const char* formula : {"x_t^2/2\n - x^2/2", "x_t^2/2\r\n- x^2/2", "x_t^2/2 -\t\r x^2/2\n"}) {
            Value scene = parseJson(sceneText);
            Value model = *scene.find("model");
            model.set("lagrangian", formula);
            scene.set("model", model);
            write(at("scene.json"), bytes(writeJson(scene)));
            QCOMPARE(tests::runProgram({"program", at("scene.json"), "--out", out}).code, 0);
            QCOMPARE(tests::runProgram({"program", at("scene.json"), "--out", cpp}).code, 0);
            int code = -1;
            QByteArray said = outputOf(EXTREMAL_PYTHON, {"-m", "py_compile", out}, code);
            QVERIFY2(code == 0, said);
            said = outputOf("g++", {"-std=c++17", "-fsyntax-only", "-Wall", "-Werror", cpp}, code);
            QVERIFY2(code == 0, said);
        }
    }

    void pagesHaveTheSameParts_data() { columns(); }
    void pagesHaveTheSameParts() {
        QFETCH(std::string, text);
        const Document plain = passportOf(sampleWith(harmless).resolved, 0, {.isMeasured = false});
        const Document page = passportOf(sampleWith(text).resolved, 0, {.isMeasured = false});
        QCOMPARE(tagsOf(QString::fromStdString(written(page, PageFormat::html))).size(),
                 tagsOf(QString::fromStdString(written(plain, PageFormat::html))).size() +
                     scripts(QString::fromStdString(text)));
        QCOMPARE(structureOf(QString::fromStdString(written(page, PageFormat::markdown))),
                 structureOf(QString::fromStdString(written(plain, PageFormat::markdown))));
        const QString tex = QString::fromStdString(written(page, PageFormat::latex));
        QStringList known = commandsOf(QString::fromStdString(written(plain, PageFormat::latex)));
        known << "\\textbackslash"
              << "\\textasciicircum"
              << "\\textasciitilde"
              << "\\text"
              << "\\{"
              << "\\}"
              << "\\#"
              << "\\%"
              << "\\&"
              << "\\$"
              << "\\_";
        for (const QString& command : commandsOf(tex)) QVERIFY2(known.contains(command), qPrintable(command));
        QString bare = tex;
        bare.remove("\\{").remove("\\}");
        QCOMPARE(bare.count('{'), bare.count('}'));
    }

    void thePageForBrowsersHasNothingActive_data() { columns(); }
    void thePageForBrowsersHasNothingActive() {
        QFETCH(std::string, text);
        ExportParts parts = sampleWith(text).parts;
        parts.frames = 2;
        QString page = reportPage(parts);
        // Its own script, which is always the same, and the policy that admits no other.
        const QString own = "<script>" + playScript() + "</script>";
        QCOMPARE(page.count(own), 1);
        page.remove(own);
        QCOMPARE(page.count("http-equiv"), 1);
        QVERIFY(page.contains("http-equiv=\"Content-Security-Policy\" content=\"" + pagePolicy() + "\""));
        static const QRegularExpression active(
            QStringLiteral(
                R"(^<(script|iframe|object|embed|base|form|link|svg|meta(?! (charset|name|http-equiv))|\w+[^>]*\son\w+\s*=))"),
            QRegularExpression::CaseInsensitiveOption);
        static const QRegularExpression attribute(QStringLiteral("(\\w+)=\"([^\"]*)\""));
        for (const QString& tag : tagsOf(page)) {
            static const QRegularExpression value(QStringLiteral("\"[^\"]*\""));
            QVERIFY2(!active.match(QString(tag).remove(value)).hasMatch(), qPrintable(tag));
            for (const QRegularExpressionMatch& match : attribute.globalMatch(tag)) {
                const QString name = match.captured(1), target = match.captured(2);
                QVERIFY2(name != "src" || target.startsWith("data:image/"), qPrintable(tag));
                QVERIFY2(name != "href" || target.startsWith("http"), qPrintable(tag));
            }
        }
        QCOMPARE(page.count("<figure>"), 2);  // the film has a name
        QCOMPARE(page.count("<script"), 0);
        for (const QChar c : page) QVERIFY(c.unicode() >= 0x20 || c == '\n' || c == '\t' || c == '\r');
    }

    void linksOfNotesThatMayStayStay() {
        const QString page = reportPage(
            sampleWith("[a](https://example.org/x) [b](file:///etc/passwd) ![c](/etc/passwd)").parts);
        QVERIFY(page.contains("href=\"https://example.org/x\""));
        QVERIFY(!page.contains("href=\"file:"));
        QVERIFY(!page.contains("src=\"/etc/passwd\""));
    }

    void picturesAreWholeAndPassive_data() { columns(); }
    void picturesAreWholeAndPassive() {
        QFETCH(std::string, text);
        const Figure plain = sampleWith(harmless).parts.figures.front();
        const Figure figure = sampleWith(text).parts.figures.front();
        QCOMPARE(elementsOf(bytes(svgOf(figure))), elementsOf(bytes(svgOf(plain))));
        const QString file = at("figure.svg");
        QCOMPARE(saveFigure(file, figure, {400, 300}, Theme::light()), QString());
        QStringList texts;
        const QStringList elements = elementsOf(contentOf(file), &texts);
        QVERIFY2(elements.filter("error").isEmpty(), qPrintable(elements.filter("error").join("; ")));
        QVERIFY(!elements.contains("script") && !elements.contains("foreignObject") &&
                !elements.contains("a"));
        QCOMPARE(elements.count("title"), 1);
        // The title is all there, but for what cannot be seen.
        if (std::all_of(text.begin(), text.end(), [](char c) { return c >= 0x20 && c < 0x7f; }))
            QCOMPARE(texts[texts.indexOf(QRegularExpression("\\S.*"))], QString::fromStdString(text));
        const QString pdf = at("figure.pdf");
        QCOMPARE(saveFigure(pdf, figure, {400, 300}, Theme::light()), QString());
        for (const char* key : {"/JavaScript", "/OpenAction", "/Launch", "/URI"})
            QVERIFY2(!contentOf(pdf).contains(key), key);
    }

    void tablesHaveTheSameCells_data() { columns(); }
    void tablesHaveTheSameCells() {
        QFETCH(std::string, text);
        const Sample sample = sampleWith(text);
        const auto plain = rowsOf(summaryCsv(*sampleWith(harmless).parts.comparison));
        const auto rows = rowsOf(summaryCsv(*sample.parts.comparison));
        QCOMPARE(rows.size(), plain.size());
        for (std::size_t i = 0; i < rows.size(); ++i) QCOMPARE(rows[i].size(), plain[i].size());
        QCOMPARE(rows[1][0], text);
        if (firstInvalidUtf8Of(text)) return;
        QCOMPARE(parseJson(writeJson(summaryValue(*sample.parts.comparison))).find("title")->asString(),
                 text);
    }

    /// As far as the contract allows: labels, which are cells, begin no formula.
    void noCellIsAFormula() {
        for (const char* text : {"=1+1", "+1", "-1", "@SUM(A1)", " =1+1", "＝1+1", "＠SUM(A1)"})
            for (const char* place : {"/schemes/0/label", "/events/0/label"}) {
                const ReadScene read = readScene(parseJson(sceneText), {{place, text}});
                QCOMPARE(read.errors.size(), std::size_t{1});
                QVERIFY2(read.errors[0].message.find("spreadsheet") != std::string::npos, text);
            }
    }

private:
    static void columns() {
        QTest::addColumn<std::string>("text");
        for (const auto& [name, text] : hostileTexts()) QTest::newRow(name) << text;
    }
    static bool firstInvalidUtf8Of(const std::string& text) {
        return !QString::fromStdString(text).isValidUtf16() ||
               QString::fromStdString(text).contains(QChar(0xfffd));
    }
    /// Indices and exponents are set by tags: as many as the text has, three times over (title, heading,
    /// table).
    static qsizetype scripts(const QString& text) {
        static const QRegularExpression script(
            QStringLiteral(R"([_^](\{[^}]*\}|\([^)]{0,5}\)|[A-Za-z0-9]{1,2}(?![A-Za-z0-9])))"));
        qsizetype count = 0;
        for ([[maybe_unused]] const auto& match : script.globalMatch(text)) ++count;
        return 2 * count;
    }
    static QByteArray pythonOf(const std::string& text) {
        return bytes(programOf(sampleWith(text).resolved, 0, ProgramLanguage::python));
    }
    static QByteArray cppOf(const std::string& text) {
        return bytes(programOf(sampleWith(text).resolved, 0, ProgramLanguage::cpp));
    }
    QString at(const QString& name) const { return folder_.filePath(name); }

    QTemporaryDir folder_;
};

EXTREMAL_TEST(HostileTextsTest)

}  // namespace extremal::hostile_texts_test

#include "hostile_texts_test.moc"
