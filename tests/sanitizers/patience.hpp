// SPDX-License-Identifier: GPL-3.0-or-later
/// Included first in the tests of the window that are built with sanitizers: programs are ten times as slow,
/// and what a test waits for may take longer than the five seconds of Qt Test.
#pragma once

#include <QTest>

#undef QTRY_VERIFY
#undef QTRY_COMPARE
#define QTRY_VERIFY(condition) QTRY_VERIFY_WITH_TIMEOUT(condition, 120000)
#define QTRY_COMPARE(value, expected) QTRY_COMPARE_WITH_TIMEOUT(value, expected, 120000)
