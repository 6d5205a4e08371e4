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

const char* const pythonByParameters = R"(    return g, H + np.tril(H, -1).T


def by_parameters(t, q, v):
    """The derivatives of this gradient by those parameters that the program differentiates by."""
    B = np.zeros((2 * d, u))
)";

const char* const pythonCommon = R"(    return B


def changes(t, q, v, dq, dv):
    """Of the gradient of L, with the columns of derivatives of q and v."""
    return derivatives(t, q, v)[1] @ np.vstack([dq, dv]) + by_parameters(t, q, v) @ d_parameters


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


# Each step also moves the columns (dq, dp) of derivatives of the state by numbers of the scene, if it is given them.
)";

const char* const pythonGalerkin = R"(
def step(t, h, q0, p0, dq=None, dp=None):
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
            break
        last = size
    else:
        raise RuntimeError('the step at t = %r does not converge' % t)
    at = [(t + c[i] * h, q0 + phi[i] @ Y, (dphi[i] @ Y) / h) for i in range(n)]
    force = sum(b[i] * derivatives(*at[i])[0][:d] for i in range(n))
    if dq is None:
        return q0 + Y[m - 1], p0 + h * force
    # With the equations R(Y; q_0, p_0, k) = 0 of the step: R_Y dY = -R_q dq_0 - R_p dp_0 - R_k dk.
    N = dq.shape[1]
    R, J = np.zeros((m, d, N)), np.zeros((m, d, m, d))
    R[m - 1] = dp
    for i in range(n):
        H, G = derivatives(*at[i])[1], changes(*at[i], dq, np.zeros((d, N)))
        R += b[i] * (h * np.einsum('a,jk->ajk', psi[i], G[:d]) + np.einsum('a,jk->ajk', dpsi[i], G[d:]))
        J += b[i] * (h * np.einsum('a,b,jk->ajbk', psi[i], phi[i], H[:d, :d])
                     + np.einsum('a,b,jk->ajbk', psi[i], dphi[i], H[:d, d:])
                     + np.einsum('a,b,jk->ajbk', dpsi[i], phi[i], H[d:, :d])
                     + np.einsum('a,b,jk->ajbk', dpsi[i], dphi[i], H[d:, d:]) / h)
    dY = np.linalg.solve(J.reshape(m * d, m * d), -R.reshape(m * d, N)).reshape(m, d, N)
    dforce = sum(b[i] * changes(*at[i], dq + np.einsum('a,ajk->jk', phi[i], dY),
                                np.einsum('a,ajk->jk', dphi[i], dY) / h)[:d] for i in range(n))
    return q0 + Y[m - 1], p0 + h * force, dq + dY[m - 1], dp + h * dforce
)";

const char* const pythonStages = R"(
def step(t, h, q0, p0, dq=None, dp=None):
    """Stages in the order in which they are known: forces at Q_i, velocities at P_j."""
    V, F = np.zeros((len(b), d)), np.zeros((len(b_hat), d))
    N, rest = 0 if dq is None else dq.shape[1], np.zeros(d)
    dV, dF = np.zeros((len(b), d, N)), np.zeros((len(b_hat), d, N))
    for is_velocity, i in order:
        if is_velocity:
            V[i] = velocity(t + c[i] * h, q0, p0 + h * A_hat[i] @ F)
            if N > 0:
                H, G = derivatives(t + c[i] * h, q0, V[i])[1], changes(t + c[i] * h, q0, V[i], dq, 0 * dq)
                dV[i] = np.linalg.solve(H[d:, d:], dp + h * np.einsum('j,jkl->kl', A_hat[i], dF) - G[d:])
        else:
            Q = q0 + h * A[i] @ V
            F[i] = derivatives(t + c_hat[i] * h, Q, rest)[0][:d]
            if N > 0:
                dF[i] = changes(t + c_hat[i] * h, Q, rest, dq + h * np.einsum('j,jkl->kl', A[i], dV), 0 * dq)[:d]
    q, p = q0 + h * b @ V, p0 + h * b_hat @ F
    if N == 0:
        return q, p
    return q, p, dq + h * np.einsum('j,jkl->kl', b, dV), dp + h * np.einsum('j,jkl->kl', b_hat, dF)
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


def field_by_parameters(t, q, p):
    v = velocity(t, q, p)
    H, B = derivatives(t, q, v)[1], by_parameters(t, q, v) @ d_parameters
    by_v = -np.linalg.solve(H[d:, d:], B[d:])
    return np.vstack([by_v, B[:d] + H[:d, d:] @ by_v])


def step(t, h, q0, p0, dq=None, dp=None):
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
    q, p = q0 + h * b @ K[:, :d], p0 + h * b_hat @ K[:, d:]
    if dq is None:
        return q, p
    # dK_i = J_i (dx_0 + h sum_j a_ij dK_j) + f_k dk.
    N = dq.shape[1]
    M, R = np.eye(2 * d * s).reshape(s, 2 * d, s, 2 * d), np.zeros((s, 2 * d, N))
    for i in range(s):
        J = field(t + c[i] * h, *stage(i))[1]
        R[i] = J @ np.vstack([dq, dp]) + field_by_parameters(t + c[i] * h, *stage(i))
        for j in range(s):
            M[i, :, j, :d] -= h * A[i, j] * J[:, :d]
            M[i, :, j, d:] -= h * A_hat[i, j] * J[:, d:]
    dK = np.linalg.solve(M.reshape(2 * d * s, -1), R.reshape(2 * d * s, N)).reshape(s, 2 * d, N)
    return q, p, dq + h * np.einsum('j,jkl->kl', b, dK[:, :d]), dp + h * np.einsum('j,jkl->kl', b_hat, dK[:, d:])
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


def derivative(steps):
    """The derivatives of (q, p) at node `steps` by the numbers, one column for each."""
    q, p = np.array(q_start), np.array(p_start)
    dq, dp = np.array(d_start[:d]), np.array(d_start[d:])
    for k in range(steps):
        at = t_start + k * h_step
        for part in parts:
            q, p, dq, dp = step(at, part * h_step, q, p, dq, dp)
            at += part * h_step
    return np.vstack([dq, dp])


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
    if sys.argv[1:] == ['--derivative']:
        print(','.join(['column'] + numbers))
        for name, row in zip(columns[1:], derivative(steps_of_the_scene)):
            print(','.join([name] + [repr(float(x)) for x in row]))
        sys.exit(0)
    if len(sys.argv) > 1:
        sys.exit(0 if test(sys.argv[1]) else 1)
    print(','.join(columns))
    for t, q, p in march(steps_of_the_scene):
        print(','.join(repr(float(x)) for x in [t, *q, *p]))
)";

}  // namespace extremal::program_text
