// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/program_text.hpp"

namespace extremal::program_text {

const char* const pythonHead = R"(import math
import sys

import numpy as np

)";

const char* const pythonDerivatives = R"(

def derivatives(t, q, v):
    """The gradient of L in (q, v), and its Hessian."""
    g, H = np.zeros(2 * d), np.zeros((2 * d, 2 * d))
)";

const char* const pythonCommon = R"(    return g, H + np.tril(H, -1).T


def velocity(t, q, p):
    """v with L_v(t, q, v) = p, by Newton from 0: one iteration where L is quadratic in v."""
    v = np.zeros(d)
    for iteration in range(60):
        g, H = derivatives(t, q, v)
        change = np.linalg.solve(H[d:, d:], p - g[d:])
        v = v + change
        if np.abs(change).max() <= 1e-15 * np.abs(v).max():
            break
    return v

)";

const char* const pythonGalerkin = R"(
def step(t, h, q0, p0):
    """sum_i b_i (h psi_a L_q + psi_a' L_v) = 0 inside, = -p_0 for the last test function; Newton from a straight line."""
    n, m = phi.shape
    Y = np.zeros((m, d))
    Y[m - 1] = h * velocity(t, q0, p0)
    last = math.inf
    for iteration in range(60):
        R, J, force = np.zeros((m, d)), np.zeros((m, d, m, d)), np.zeros(d)
        R[m - 1] = p0
        for i in range(n):
            g, H = derivatives(t + c[i] * h, q0 + phi[i] @ Y, (dphi[i] @ Y) / h)
            R += b[i] * (h * np.outer(psi[i], g[:d]) + np.outer(dpsi[i], g[d:]))
            force += b[i] * g[:d]
            J += b[i] * (h * np.einsum('a,b,jk->ajbk', psi[i], phi[i], H[:d, :d])
                         + np.einsum('a,b,jk->ajbk', psi[i], dphi[i], H[:d, d:])
                         + np.einsum('a,b,jk->ajbk', dpsi[i], phi[i], H[d:, :d])
                         + np.einsum('a,b,jk->ajbk', dpsi[i], dphi[i], H[d:, d:]) / h)
        change = np.linalg.solve(J.reshape(m * d, m * d), -R.reshape(m * d)).reshape(m, d)
        Y = Y + change
        size, scale = np.abs(change).max(), max(np.abs(Y).max(), np.abs(q0).max())
        if size <= 1e-16 * scale or (size < 1e-11 * scale and size >= last / 4):
            force = sum(b[i] * derivatives(t + c[i] * h, q0 + phi[i] @ Y, (dphi[i] @ Y) / h)[0][:d] for i in range(n))
            return q0 + Y[m - 1], p0 + h * force
        last = size
    raise RuntimeError('the step at t = %r does not converge' % t)
)";

const char* const pythonStages = R"(
def step(t, h, q0, p0):
    """Stages in the order in which they are known: forces at Q_i, velocities at P_j."""
    V, F = np.zeros((len(b), d)), np.zeros((len(b_hat), d))
    for is_velocity, i in order:
        if is_velocity:
            V[i] = velocity(t + c[i] * h, q0, p0 + h * A_hat[i] @ F)
        else:
            F[i] = derivatives(t + c_hat[i] * h, q0 + h * A[i] @ V, np.zeros(d))[0][:d]
    return q0 + h * b @ V, p0 + h * b_hat @ F
)";

const char* const pythonRungeKutta = R"(
def field(t, q, p):
    """Hamilton's vector field and its Jacobian, from L: p = L_v, p' = L_q."""
    v = velocity(t, q, p)
    g, H = derivatives(t, q, v)
    inverse = np.linalg.inv(H[d:, d:])
    by_q = -inverse @ H[d:, :d]
    J = np.block([[by_q, inverse], [H[:d, :d] + H[:d, d:] @ by_q, H[:d, d:] @ inverse]])
    return np.concatenate([v, g[:d]]), J


def step(t, h, q0, p0):
    """K_i = f(x_0 + h sum_j a_ij K_j), with A for q and A_hat for p: stage by stage, or by Newton for all."""
    s = len(b)
    K = np.zeros((s, 2 * d))
    stage = lambda i: (q0 + h * A[i] @ K[:, :d], p0 + h * A_hat[i] @ K[:, d:])
    if is_explicit:
        for i in range(s):
            K[i] = field(t + c[i] * h, *stage(i))[0]
    else:
        K[:] = field(t, q0, p0)[0]
        last = math.inf
        for iteration in range(60):
            R, M = np.zeros((s, 2 * d)), np.eye(2 * d * s).reshape(s, 2 * d, s, 2 * d)
            for i in range(s):
                f, J = field(t + c[i] * h, *stage(i))
                R[i] = f - K[i]
                for j in range(s):
                    M[i, :, j, :d] -= h * A[i, j] * J[:, :d]
                    M[i, :, j, d:] -= h * A_hat[i, j] * J[:, d:]
            change = np.linalg.solve(M.reshape(2 * d * s, -1), R.reshape(-1)).reshape(s, 2 * d)
            K += change
            size, scale = np.abs(change).max(), np.abs(K).max()
            if size <= 1e-16 * scale or (size < 1e-11 * scale and size >= last / 4):
                break
            last = size
        else:
            raise RuntimeError('the step at t = %r does not converge' % t)
    return q0 + h * b @ K[:, :d], p0 + h * b_hat @ K[:, d:]
)";

const char* const pythonMain = R"(

def march(steps):
    """(t, q, p) at nodes 0..steps."""
    q, p = np.array(q_start), np.array(p_start)
    yield t_start, q, p
    for k in range(steps):
        at = t_start + k * h_step
        for part in parts:
            q, p = step(at, part * h_step, q, p)
            at += part * h_step
        yield t_start + (k + 1) * h_step, q, p


def test(path):
    """Largest difference from the rows of a CSV of the run, relative to the largest entry of the state."""
    with open(path) as file:
        header = file.readline().strip().split(',')
        rows = [line.strip().split(',')[:1 + 2 * d] for line in file]
    assert header[:1 + 2 * d] == columns, 'the columns must begin with ' + ','.join(columns)
    rows = {round((float(row[0]) - t_start) / h_step): [float(x) for x in row[1:]] for row in rows}
    worst, scale = 0.0, 0.0
    for k, (t, q, p) in enumerate(march(max(rows))):
        x = np.concatenate([q, p])
        scale = max(scale, np.abs(x).max())
        if k in rows:
            worst = max(worst, np.abs(x - rows[k]).max())
    print('%d rows, largest difference %.2e of %.3g' % (len(rows), worst, scale))
    return worst <= 1e-13 * scale


if __name__ == '__main__':
    if len(sys.argv) > 1:
        sys.exit(0 if test(sys.argv[1]) else 1)
    print(','.join(columns))
    for t, q, p in march(steps_of_the_scene):
        print(','.join(repr(float(x)) for x in [t, *q, *p]))
)";

}  // namespace extremal::program_text
