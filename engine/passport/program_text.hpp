// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of exported programs that are the same for all. Internal to engine/passport.
#pragma once

namespace extremal::program_text {

// Python: imports before the tables; behind them the function derivatives(t, q, v) between its head and its
// end, and the one for derivatives by parameters; the velocity; the step, one of three, which moves columns
// of derivatives along; and what runs and compares it.
extern const char* const pythonHead;
extern const char* const pythonDerivatives;
extern const char* const pythonByParameters;
extern const char* const pythonCommon;
extern const char* const pythonGalerkin;
extern const char* const pythonStages;
extern const char* const pythonRungeKutta;
extern const char* const pythonMain;
// C++ likewise.
extern const char* const cppHead;
extern const char* const cppDerivatives;
extern const char* const cppByParameters;
extern const char* const cppCommon;
extern const char* const cppGalerkin;
extern const char* const cppStages;
extern const char* const cppRungeKutta;
extern const char* const cppMain;

}  // namespace extremal::program_text
