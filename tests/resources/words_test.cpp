// SPDX-License-Identifier: GPL-3.0-or-later
/// Words that the program does not use, because a reader cannot know what they mean: each was an internal
/// name, or a figure of speech, for something that has a name in the field.
#include <QRegularExpression>
#include <QTest>

#include "tests/resources/tree_text.hpp"
#include "tests/tools/test.hpp"

namespace extremal::words_test {

namespace {

struct Word {
    const char* pattern;
    const char* better;
};

/// The paper is "Leok 2004", its scheme "Leok's scheme". Seeds of random numbers, and the ids of presets, are
/// others.
const Word words[] = {
    {R"(Nothing is called that)", "No matching action"},
    {R"(\bmakes? no sense\b)", "unsupported combination"},
    {R"(\b[Nn]obody\b|\btidies\b)", "a plain statement, without persons"},
    {R"(\b[Kk]ept pictures?\b|\bLookAsKept\b|\bLooksAsKept\b)", "golden image"},
    {R"(\b[Tt]he seed\b(?! of random)|\b[Ss]eed's\b|\b[Ss]eed paper\b)", "Leok 2004, or Leok's scheme"},
};

QStringList faultsIn(const QString& path, const QString& text) {
    QStringList faults;
    for (const Word& word : words) {
        auto matches = QRegularExpression(word.pattern).globalMatch(text);
        while (matches.hasNext())
            faults << path + ": '" + matches.next().captured(0) + "': write " + word.better;
    }
    return faults;
}

}  // namespace

class WordsTest : public QObject {
    Q_OBJECT

private slots:
    void noTextUsesThem() {
        QStringList faults;
        for (const QString& path : tree_text::everyText())
            if (!path.endsWith("words_test.cpp")) faults << faultsIn(path, tree_text::runningText(path));
        QVERIFY2(faults.isEmpty(), qPrintable(faults.join("\n")));
    }

    void theyAreFound() {
        for (const char* text : {"The seed's scheme", "as the seed has it", "a seed paper"})
            QVERIFY2(!faultsIn("a", text).isEmpty(), text);
        QVERIFY(faultsIn("a", R"(from a seed: {"name": "random", "seed": 7}, preset seed-spring)").isEmpty());
    }
};

EXTREMAL_TEST(WordsTest)
}  // namespace extremal::words_test

#include "words_test.moc"
