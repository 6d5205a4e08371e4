// SPDX-License-Identifier: GPL-3.0-or-later
/// The four-bar (four_bar.hpp) by IDA of SUNDIALS: the stabilised equations of index 2 (Gear, Gupta and
/// Leimkuhler), as for chains (ida_chain.hpp), with a dense Jacobian by difference quotients.
///     q' = v + g_q^T mu,   M v' = f + g_q^T lambda,   g(q) = 0,   g_q v = 0
/// Needs SUNDIALS_IDA.
#pragma once

#ifdef EXTREMAL_HAS_IDA
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <optional>

#include "tests/bench/four_bar.hpp"

namespace extremal::bench {

/// Unknowns are q, v, lambda, mu.
inline int fourBarResidual(realtype, N_Vector state, N_Vector rate, N_Vector to, void*) {
    const double *const z = N_VGetArrayPointer(state), *const dz = N_VGetArrayPointer(rate);
    double* const r = N_VGetArrayPointer(to);
    const FourBar::Rods at(z);
    const auto f = FourBar::forces(z);
    const auto pull = [&](const double* l) {
        return std::array{l[0] * at.rx - l[1] * at.dx, l[0] * at.ry - l[1] * at.dy,
                          l[1] * at.dx + l[2] * at.ex, l[1] * at.dy + l[2] * at.ey};
    };
    const auto force = pull(z + 8), shift = pull(z + 11);
    for (std::size_t i = 0; i < 4; ++i) {
        r[i] = dz[i] - z[4 + i] - shift[i];
        r[4 + i] = (i < 2 ? FourBar::m1 : FourBar::m2) * dz[4 + i] - f[i] - force[i];
    }
    r[8] = (at.rx * at.rx + at.ry * at.ry - 1) / 2;
    r[9] = (at.dx * at.dx + at.dy * at.dy - FourBar::coupler * FourBar::coupler) / 2;
    r[10] = (at.ex * at.ex + at.ey * at.ey - FourBar::rocker * FourBar::rocker) / 2;
    r[11] = at.rx * z[4] + at.ry * z[5];
    r[12] = at.dx * (z[6] - z[4]) + at.dy * (z[7] - z[5]);
    r[13] = at.ex * z[6] + at.ey * z[7];
    return 0;
}

/// x1, y1, x2, y2 at T; nothing where IDA gives up.
inline std::optional<std::array<double, 4>> idaFourBar(const FourBar::State& start, double T,
                                                       double tolerance) {
    constexpr sunindextype size = 14;
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    N_Vector z = N_VNew_Serial(size, context), dz = N_VClone(z), kind = N_VClone(z), absolute = N_VClone(z);
    double *const to = N_VGetArrayPointer(z), *const rate = N_VGetArrayPointer(dz);
    N_VConst(0, z);
    N_VConst(0, dz);
    const auto lambda = FourBar::multipliers(start.data());
    std::copy(start.begin(), start.end(), to);
    std::copy(lambda.begin(), lambda.end(), to + 8);
    std::copy_n(start.begin() + 4, 4, rate);
    FourBar::accelerate(start.data(), rate + 4);
    // Multipliers are known to 1/h of the rest: in Newton's norm they would hold the steps down.
    for (sunindextype i = 0; i < size; ++i) {
        N_VGetArrayPointer(kind)[i] = i < 8 ? 1 : 0;
        N_VGetArrayPointer(absolute)[i] = i < 8 ? tolerance : 1e6 * tolerance;
    }
    void* memory = IDACreate(context);
    IDASetErrFile(memory, nullptr);
    IDAInit(memory, &fourBarResidual, 0, z, dz);
    IDASVtolerances(memory, tolerance, absolute);
    IDASetId(memory, kind);
    IDASetSuppressAlg(memory, SUNTRUE);
    IDASetMaxNumSteps(memory, 1'000'000);
    SUNMatrix matrix = SUNDenseMatrix(size, size, context);
    SUNLinearSolver solver = SUNLinSol_Dense(z, matrix, context);
    IDASetLinearSolver(memory, solver, matrix);
    IDASetStopTime(memory, T);
    double t = 0;
    const int status = IDASolve(memory, T, &t, z, dz, IDA_NORMAL);
    const std::array<double, 4> places{to[0], to[1], to[2], to[3]};
    IDAFree(&memory);
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    for (N_Vector each : {z, dz, kind, absolute}) N_VDestroy(each);
    SUNContext_Free(&context);
    if (status < 0 || t < T) return {};
    return places;
}

}  // namespace extremal::bench
#endif
