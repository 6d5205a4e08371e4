/// The parts of exported programs that are the same for all. Internal to engine/passport.
#pragma once

namespace extremal::program_text {

// Python: what every program has behind its tables and its function derivatives(t, q, v).
extern const char* const pythonGalerkin;
extern const char* const pythonStages;
extern const char* const pythonRungeKutta;
extern const char* const pythonMain;
// C++ likewise.
extern const char* const cppCommon;
extern const char* const cppGalerkin;
extern const char* const cppStages;
extern const char* const cppRungeKutta;
extern const char* const cppMain;

}  // namespace extremal::program_text
