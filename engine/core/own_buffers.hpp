// SPDX-License-Identifier: GPL-3.0-or-later
/// Buffers for calls through a constant model, which several threads make at a time: each thread has a set of
/// its own. One is kept, since a thread integrates one system at a time.
#pragma once

#include <atomic>
#include <optional>

namespace extremal {

/// By which a model is known to ownBuffers(); no two models have the same.
inline long long nextModelId() {
    static std::atomic<long long> next{0};
    return next++;
}

/// The set of this thread for the model with this id, made from `model` where the last one was that of
/// another model.
template <class Buffers, class Model>
Buffers& ownBuffers(long long id, const Model& model) {
    thread_local std::optional<Buffers> own;
    thread_local long long of = -1;
    if (of != id) {
        own.emplace(model);
        of = id;
    }
    return *own;
}

}  // namespace extremal
