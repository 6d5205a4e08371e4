// SPDX-License-Identifier: GPL-3.0-or-later
/// A chain (chains.hpp) by IDA of SUNDIALS, as a differential-algebraic code is used for it: the stabilised
/// equations of index 2 (Gear, Gupta and Leimkuhler), with unknowns link by link, so that their Jacobian has
/// a band, by difference quotients.
///     q' = v + g_q^T mu,   v' = f + g_q^T lambda,   g(q) = 0,   g_q v = 0
/// Multipliers are left out of the error test. Needs SUNDIALS_IDA.
#pragma once

#ifdef EXTREMAL_HAS_IDA
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunmatrix/sunmatrix_band.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "engine/mechanism/mechanism.hpp"
#include "tests/bench/chains.hpp"

namespace extremal::bench {

/// The residual; link i has (x, y, vx, vy, lambda, mu) at 6 i.
inline int chainResidual(realtype, N_Vector state, N_Vector rate, N_Vector to, void* links) {
    const int n = *static_cast<const int*>(links);
    const double *const z = N_VGetArrayPointer(state), *const dz = N_VGetArrayPointer(rate);
    double* const r = N_VGetArrayPointer(to);
    const auto at = [&](int i, int k) { return i < 0 ? 0.0 : z[6 * i + k]; };
    for (int i = 0; i < n; ++i) {
        const double x = at(i, 0) - at(i - 1, 0), y = at(i, 1) - at(i - 1, 1);
        double ux = 2 * x * at(i, 5), uy = 2 * y * at(i, 5), fx = 2 * x * at(i, 4),
               fy = 2 * y * at(i, 4) - 9.81;
        if (i + 1 < n) {
            const double nextX = at(i + 1, 0) - at(i, 0), nextY = at(i + 1, 1) - at(i, 1);
            ux -= 2 * nextX * at(i + 1, 5);
            uy -= 2 * nextY * at(i + 1, 5);
            fx -= 2 * nextX * at(i + 1, 4);
            fy -= 2 * nextY * at(i + 1, 4);
        }
        double* const row = r + 6 * i;
        row[0] = dz[6 * i] - at(i, 2) - ux;
        row[1] = dz[6 * i + 1] - at(i, 3) - uy;
        row[2] = dz[6 * i + 2] - fx;
        row[3] = dz[6 * i + 3] - fy;
        row[4] = x * x + y * y - 1;
        row[5] = 2 * x * (at(i, 2) - at(i - 1, 2)) + 2 * y * (at(i, 3) - at(i - 1, 3));
    }
    return 0;
}

/// The place of the last ball at T; nothing where IDA gives up, or takes more than `longest` CPU seconds.
inline std::optional<std::pair<double, double>> idaTip(const Chain& of, double T, double tolerance,
                                                       double longest) {
    int links = static_cast<int>(of.start.x.size() / 4);
    const auto size = static_cast<sunindextype>(6 * links);
    Mechanism mechanism(of.system.parts);
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(2 * links);
    Eigen::VectorXd acceleration, multipliers;
    if (!mechanism.accelerate(0, of.start.x.data(), rest.data(), acceleration, multipliers)) return {};
    SUNContext context = nullptr;
    SUNContext_Create(nullptr, &context);
    N_Vector z = N_VNew_Serial(size, context), dz = N_VClone(z), kind = N_VClone(z);
    N_VConst(0, z);
    N_VConst(0, dz);
    N_VConst(1, kind);
    for (int i = 0; i < links; ++i) {
        double *const to = N_VGetArrayPointer(z) + 6 * i, *const rate = N_VGetArrayPointer(dz) + 6 * i;
        to[0] = of.start.x[static_cast<std::size_t>(i)];
        to[1] = of.start.x[static_cast<std::size_t>(links + i)];
        to[4] = multipliers(i);
        rate[2] = acceleration(i);
        rate[3] = acceleration(links + i);
        N_VGetArrayPointer(kind)[6 * i + 4] = N_VGetArrayPointer(kind)[6 * i + 5] = 0;
    }
    void* memory = IDACreate(context);
    IDASetErrFile(memory, nullptr);
    IDAInit(memory, &chainResidual, 0, z, dz);
    // Multipliers are known to 1/h of the rest: in Newton's norm they would hold the steps down.
    N_Vector absolute = N_VClone(z);
    for (sunindextype i = 0; i < size; ++i)
        N_VGetArrayPointer(absolute)[i] = i % 6 < 4 ? tolerance : 1e6 * tolerance;
    IDASVtolerances(memory, tolerance, absolute);
    IDASetUserData(memory, &links);
    IDASetId(memory, kind);
    IDASetSuppressAlg(memory, SUNTRUE);
    IDASetMaxNumSteps(memory, 1'000'000);
    SUNMatrix matrix = SUNBandMatrix(size, 11, 11, context);
    SUNLinearSolver solver = SUNLinSol_Band(z, matrix, context);
    IDASetLinearSolver(memory, solver, matrix);
    IDASetStopTime(memory, T);
    double t = 0;
    int status = 0;
    for (const double from = cpuSeconds(); t < T && status >= 0 && cpuSeconds() - from < longest;)
        status = IDASolve(memory, T, &t, z, dz, IDA_ONE_STEP);
    long steps = 0;
    IDAGetNumSteps(memory, &steps);
    if (t < T) std::printf("    IDA %.0e: %ld steps to t = %.3g\n", tolerance, steps, t);
    const double* const last = N_VGetArrayPointer(z) + 6 * (links - 1);
    const std::pair<double, double> tip{last[0], last[1]};
    IDAFree(&memory);
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    for (N_Vector each : {z, dz, kind, absolute}) N_VDestroy(each);
    SUNContext_Free(&context);
    if (t < T) return {};
    return tip;
}

}  // namespace extremal::bench
#endif
