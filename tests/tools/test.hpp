// SPDX-License-Identifier: GPL-3.0-or-later
/// The test classes of a folder are one program: each registers itself, and the program runs the one that is
/// named.
///
///     namespace extremal::laws::order_test {  // the file's own, since files are compiled some at a time
///     class OrderTest : public QObject { ... };
///     EXTREMAL_TEST(OrderTest)
///     }
///     #include "order_test.moc"
///
/// As tests/laws/order_test.cpp this is run by `test.laws order`. Arguments after the name are those of Qt
/// Test.
#pragma once

#include <QObject>

#include <memory>

namespace extremal::tests {

struct RegisteredTest {
    RegisteredTest(const char* file, std::unique_ptr<QObject> (*make)());
};

template <class Test>
std::unique_ptr<QObject> makeTest() {
    return std::make_unique<Test>();
}

}  // namespace extremal::tests

#define EXTREMAL_TEST(Class)                                                   \
    static const ::extremal::tests::RegisteredTest registered##Class{__FILE__, \
                                                                     ::extremal::tests::makeTest<Class>};
