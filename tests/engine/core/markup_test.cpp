// SPDX-License-Identifier: GPL-3.0-or-later
/// What has a meaning in HTML and XML is escaped, once.
#include <QTest>

#include "engine/core/text/markup.hpp"
#include "tests/tools/test.hpp"

namespace extremal::markup_test {

class MarkupTest : public QObject {
    Q_OBJECT
private slots:
    void specialCharactersAreEscaped() {
        QCOMPARE(markupText("a < b > c & \"d\""), std::string("a &lt; b &gt; c &amp; &quot;d&quot;"));
        QCOMPARE(markupText("&lt;"), std::string("&amp;lt;"));
        QCOMPARE(markupText("ω² 'x'"), std::string("ω² 'x'"));
    }
    void whatCannotBeSeenIsANumber() {
        QCOMPARE(markupText("a\nb\tc\x01\ufffe"), std::string("a\nb\tcU+0001U+FFFE"));
        QCOMPARE(visibleLine("a\r\nb\u2028c\u0085d\u202ee\xff"), std::string("a  b c dU+202EeU+FFFD"));
        QCOMPARE(visibleLine("Störmer ω ½ 𝑥"), std::string("Störmer ω ½ 𝑥"));
    }
    void commentsEndWithTheirLine() {
        QCOMPARE(commentText("a\nb"), std::string("a b"));
        QCOMPARE(commentText("a\\  "), std::string("a\\."));
        QCOMPARE(commentText("a?\?/"), std::string("a?\?/."));
        QCOMPARE(commentText("C:\\x"), std::string("C:\\x"));
    }
    void literalsHoldTheirText() {
        QCOMPARE(cppString("q.x,\"\\?\nω"), std::string("\"q.x,\\\"\\\\\\?\\012\\317\\211\""));
        QCOMPARE(pythonString("q.x'\\\nω\u2028"), std::string("'q.x\\'\\\\\\U0000000aω\\U00002028'"));
    }
    void linksOfMarkdownAreText() {
        QCOMPARE(markdownText("[a](b) ![c][d] [e]: f & |"),
                 std::string("[a\\](b) ![c\\][d] [e\\]: f &amp; \\|"));
        QCOMPARE(markdownText("[0, 1] a_t"), std::string("[0, 1] a\\_t"));
        QCOMPARE(markdownListing({"a", "```` b"}), std::string("`````\na\n```` b\n`````\n"));
    }
    void commandsOfLatexAreText() {
        QCOMPARE(latexText("\\input{a}\n%"), std::string("\\textbackslash{}input\\{a\\} \\%"));
        QCOMPARE(latexListing({"\\end{verbatim}"}),
                 std::string("\\begin{verbatim}\n\\end {verbatim}\n\\end{verbatim}\n"));
    }
};

EXTREMAL_TEST(MarkupTest)

}  // namespace extremal::markup_test

#include "markup_test.moc"
