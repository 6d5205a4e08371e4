// SPDX-License-Identifier: GPL-3.0-or-later
/// Undo and redo: the previous documents, each with what was typed and refused at that time, so that neither
/// is lost. Edits of the same place in quick succession (a dragged slider) merge.
#pragma once

#include <QElapsedTimer>
#include <QString>
#include <map>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

struct EditState {
    Value document;
    std::map<std::string, Value> drafts;  ///< by their places
    bool operator==(const EditState&) const = default;
};

class History {
public:
    /// Forgets everything.
    void clear();
    /// Keeps `before`, the state as it was; `what` names the change ("Change stiffness").
    void push(EditState before, const QString& what, const QString& mergeKey);

    bool canUndo() const { return !past_.empty(); }
    bool canRedo() const { return !future_.empty(); }
    QString undoText() const { return canUndo() ? past_.back().what : QString(); }
    QString redoText() const { return canRedo() ? future_.back().what : QString(); }
    /// The state to return to; `now` is stored for redo.
    EditState undo(EditState now);
    EditState redo(EditState now);

private:
    struct Entry {
        EditState state;
        QString what, mergeKey;
    };
    std::vector<Entry> past_, future_;
    QElapsedTimer sincePush_;
};

}  // namespace extremal
