// SPDX-License-Identifier: GPL-3.0-or-later
/// Citations of the paper that the program is built on (M. Leok, Generalized Galerkin variational
/// integrators, 2004) name sections that exist, and a section whose subject is that of the file:
///
///     1 introduction, with multisymplectic geometry (1.1, 1.2, 1.3)    5 symplectic-energy-momentum
///     2 the framework (2.1 special cases)                              6 spatio-temporally adaptive
///     3 Lie groups (3.1 Galerkin, 3.2 natural charts)                  7 multiscale (7.1 elliptic, 7.2
///     pendulum, 4 discrete Euler-Poincare (4.1 reduced Lagrangian,                 7.3 computational
///     aspects)
///       4.2 equations)                                                 8 pseudospectral (8.1, 8.2
///       Schroedinger)
///                                                                      9 conclusions
#include <QRegularExpression>
#include <QTest>

#include "tests/resources/tree_text.hpp"
#include "tests/tools/test.hpp"

namespace extremal::citations_test {

namespace {

const QStringList sections{"1",   "1.1", "1.2", "1.3", "2",   "2.1", "3",   "3.1", "3.2", "4",   "4.1",
                           "4.2", "5",   "6",   "7",   "7.1", "7.2", "7.3", "8",   "8.1", "8.2", "9"};

/// Files whose path (of a preset: whose model type) matches `files` cite sections that match `sections`.
struct Topic {
    const char* files;
    const char* sections;
};
const Topic topics[] = {
    {"multiscale-elliptic|elliptic", "7(\\.1)?"},
    {"static-profile|knots", "6"},
    {"family/multiscale/|filon|spring_pendulum", "7(\\.[23])?"},
    {"schrodinger|/wave/", "8(\\.[12])?"},
    {"rigid-body|heavy-top|/lie/|engine/group/|averaging", "[34](\\.[12])?"},
    {"family/galerkin/|space/polynomial|engine/action/|galerkin_step", "2(\\.1)?"},
    {"energy_momentum|energy-momentum", "(5|2\\.1)"},
    {"moving_mesh", "6"},
};

/// Sections of all citations in `text`: "Leok 2004, sec. 3.2 and 4.2" gives "3.2" and "4.2". A citation
/// without a section gives an empty string, unless it is in a list of sources.
QStringList citedSections(const QString& text) {
    static const QRegularExpression citation(R"(Leok 2004(, secs?\. (\d+(\.\d+)*)( and (\d+(\.\d+)*))?)?)");
    QStringList cited;
    auto matches = citation.globalMatch(text);
    while (matches.hasNext()) {
        const QRegularExpressionMatch match = matches.next();
        cited << match.captured(2);
        if (match.hasCaptured(5)) cited << match.captured(5);
    }
    return cited;
}

/// What a file is about: its path, and the type of the model where it is a preset.
QString subjectOf(const QString& path) {
    static const QRegularExpression type("\"model\": \\{\\s*\"type\": \"([^\"]+)\"");
    if (!path.startsWith("presets/")) return path;
    return type.match(tree_text::text(path)).captured(1);
}

QString fault(const QString& subject, const QString& section) {
    if (!sections.contains(section)) return "the paper has no section '" + section + "'";
    for (const Topic& topic : topics)
        if (subject.contains(QRegularExpression(topic.files)))
            return QRegularExpression(QRegularExpression::anchoredPattern(topic.sections))
                           .match(section)
                           .hasMatch()
                       ? QString()
                       : "section " + section + " is not about " + subject;
    return {};
}

}  // namespace

class CitationsTest : public QObject {
    Q_OBJECT

private slots:
    void everyCitationNamesASectionOnTheSubjectOfItsFile() {
        int citations = 0;
        QStringList faults;
        for (const QString& path : tree_text::everyText()) {
            if (path.startsWith("tests/resources/")) continue;  // its own examples
            const QString subject = subjectOf(path);
            QVERIFY2(!subject.isEmpty() || path.endsWith("schema.json"), qPrintable(path));
            for (const QString& section : citedSections(tree_text::runningText(path))) {
                ++citations;
                const QString what = fault(subject, section);
                if (!what.isEmpty()) faults << path + ": " + what;
            }
        }
        QVERIFY2(faults.isEmpty(), qPrintable(faults.join("\n")));
        QVERIFY(citations > 60);
    }

    void wrongCitationsAreFound() {
        QCOMPARE(citedSections("Source: Leok 2004, sec. 3.2 and 4.2. Leok 2004, sec. 10; Leok 2004"),
                 (QStringList{"3.2", "4.2", "10", ""}));
        QVERIFY(fault("spring-pendulum", "7.2").isEmpty());
        QVERIFY(!fault("kepler", "10").isEmpty());
        QVERIFY(!fault("kepler", "").isEmpty());
        QVERIFY(!fault("schrodinger-2d", "6").isEmpty());
        QVERIFY(!fault("multiscale-elliptic", "6.1").isEmpty());
        QVERIFY(!fault("engine/family/multiscale/product.hpp", "6").isEmpty());
        QVERIFY(!fault("engine/family/lie/lie_step.hpp", "2.1").isEmpty());
        QVERIFY(!fault("heavy-top", "5").isEmpty());
    }
};

EXTREMAL_TEST(CitationsTest)
}  // namespace extremal::citations_test

#include "citations_test.moc"
