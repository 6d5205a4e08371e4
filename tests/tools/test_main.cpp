// SPDX-License-Identifier: GPL-3.0-or-later
/// The main function of every test program, see test.hpp.
#include "tests/tools/test.hpp"

#include <QTest>

#include <cstdio>
#include <map>
#include <string>
#include <vector>
#ifdef QT_WIDGETS_LIB
#include <QApplication>
#endif

namespace extremal::tests {
namespace {

#ifdef QT_WIDGETS_LIB
using Application = QApplication;
#else
using Application = QCoreApplication;
#endif
using Tests = std::map<std::string, std::unique_ptr<QObject> (*)()>;

Tests& tests() {
    static Tests all;
    return all;
}

/// /path/tests/engine/scene/codec_test.cpp is scene.codec of test.engine.
std::string nameOf(std::string file) {
    file.erase(0, file.rfind("/tests/") + 7);
    file.erase(0, file.find('/') + 1);
    file.erase(file.rfind("_test.cpp"));
    for (char& c : file)
        if (c == '/') c = '.';
    return file;
}

int run(int argc, char** argv) {
    const auto test = argc > 1 ? tests().find(argv[1]) : tests().end();
    if (test == tests().end()) {
        std::fprintf(stderr, "usage: %s TEST [FUNCTION...] [option of Qt Test...], where TEST is one of\n",
                     argv[0]);
        for (const auto& [name, make] : tests()) std::fprintf(stderr, "  %s\n", name.c_str());
        return 2;
    }
    std::vector<char*> arguments(argv, argv + argc + 1);
    arguments.erase(arguments.begin() + 1);
    int count = argc - 1;
    Application application(count, arguments.data());
    application.setAttribute(Qt::AA_Use96Dpi, true);  // as QTEST_MAIN does
    return QTest::qExec(test->second().get(), count, arguments.data());
}

}  // namespace

RegisteredTest::RegisteredTest(const char* file, std::unique_ptr<QObject> (*make)()) {
    tests()[nameOf(file)] = make;
}

}  // namespace extremal::tests

int main(int argc, char** argv) { return extremal::tests::run(argc, argv); }
