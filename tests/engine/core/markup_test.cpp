/// What has a meaning in HTML and XML is escaped, once.
#include <QTest>

#include "engine/core/markup.hpp"
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
};

EXTREMAL_TEST(MarkupTest)

}  // namespace extremal::markup_test

#include "markup_test.moc"
