// The structure of a model is changed through a ModelEdit. It declares what the change invalidates, and the model is marked when the edit
// ends.
#pragma once

#include <algorithm>
#include <cstdint>

namespace kaya {

struct Model;

/// Derived data that a change invalidates.
enum class Change : std::uint8_t {
    blocks,     ///< new blocks: contacts are searched, and properties computed
    rows,       ///< the same, and rows of blocks moved or the shape of a block changed
    surfaces,   ///< faces are divided differently: contacts are searched
    contacts,   ///< contacts or cables changed, or their law: properties and lists are rebuilt
    properties, ///< masses, stiffnesses, conditions or the time step: recomputed
    lists       ///< interaction lists, after the whole model was replaced
};

/// Dirty flags of derived data; the code that rebuilds it clears them. After a restore the lists are dirty.
class Stale {
public:
    bool contacts() const { return contacts_; }     ///< must be searched again
    bool properties() const { return properties_; } ///< masses, stiffnesses, the time step must be recomputed
    bool lists() const { return lists_; }           ///< interaction lists must be rebuilt
    bool any() const { return contacts_ || properties_ || lists_; }

    void contacts_found() {
        contacts_ = false;
        properties_ = lists_ = true;
    }
    void properties_computed() { properties_ = false; }
    void lists_made() { lists_ = false; }

    /// Another number after each change in which rows of blocks moved, or the whole model became another one. No part of
    /// the state.
    std::uint64_t rows_revision() const { return rows_revision_; }

    Stale() = default;
    Stale(const Stale&) = default;
    Stale& operator=(const Stale& other) {
        contacts_ = other.contacts_;
        properties_ = other.properties_;
        lists_ = other.lists_;
        rows_revision_ = std::max(rows_revision_, other.rows_revision_) + 1;
        return *this;
    }

    template <class Archive> void visit(Archive& archive) {
        archive.value("structure_changed", contacts_);
        archive.value("properties_changed", properties_);
        archive.value("lists_changed", lists_);
    }

private:
    friend class ModelEdit;
    void raise(Change change) {
        const bool structure = change == Change::blocks || change == Change::rows;
        contacts_ = contacts_ || structure || change == Change::surfaces;
        properties_ = properties_ || structure || change == Change::properties || change == Change::contacts;
        lists_ = lists_ || change == Change::contacts || change == Change::lists;
        if (change == Change::rows) ++rows_revision_;
    }

    bool contacts_ = true, properties_ = true, lists_ = true;
    std::uint64_t rows_revision_ = 0;
};

/// A change of the model, from here to the end of the block of statements; also when it ends half done.
class ModelEdit {
public:
    ModelEdit(Model& model, Change change);
    ~ModelEdit() { stale_.raise(change_); }
    ModelEdit(const ModelEdit&) = delete;
    ModelEdit& operator=(const ModelEdit&) = delete;

private:
    Stale& stale_;
    Change change_;
};

} // namespace kaya
