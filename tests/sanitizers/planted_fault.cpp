// SPDX-License-Identifier: GPL-3.0-or-later
/// A deliberate fault, named by the argument, inside Qt's event loop as in every test of the window: the
/// sanitizers must report it, whatever the lists suppress.
#include <QCoreApplication>
#include <QTimer>

#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace {

int shared = 0;

void race() {
    std::jthread other([] { ++shared; });
    ++shared;
}

void bounds() {
    const std::vector<int> three(3);
    volatile std::size_t behind = 3;
    std::printf("%d\n", three.data()[behind]);
}

void leak() { std::printf("%p\n", static_cast<void*>(new std::vector<int>(100))); }

void overflow() {
    volatile int most = std::numeric_limits<int>::max();
    std::printf("%d\n", most + 1);
}

}  // namespace

int main(int argc, char** argv) {
    const QCoreApplication application(argc, argv);
    const std::map<std::string, std::function<void()>> faults{
        {"race", race}, {"bounds", bounds}, {"leak", leak}, {"overflow", overflow}};
    const auto fault = faults.find(argc == 2 ? argv[1] : "");
    if (fault == faults.end()) return 2;
    QTimer::singleShot(0, [&] {
        fault->second();
        QCoreApplication::quit();
    });
    return QCoreApplication::exec();
}
