// One row for each kind of object and one for each relation between them. Selection, fields, histories, scripts, groups,
// lists and files for ParaView read these tables: a new kind, or a relation that FISH walks, is one row.
#pragma once

#include "base/object_kind.hpp"
#include "model/tables/model.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace kaya {

/// Identity of an object while others are created and deleted.
struct Identity {
    std::uint32_t slot = 0;
    std::uint32_t generation = 0; ///< 0: nothing
};

struct KindInfo {
    ObjectKind kind = ObjectKind::none;
    std::string_view name = {}; ///< of scripts and files: "sub_contact"
    const char* noun = "";      ///< of messages: "sub-contact"
    const char* plural = "";    ///< "sub-contacts"
    std::string_view file = {}; ///< name of its list in exported tables: "sub-contacts"; "": has none
    std::size_t (*count)(const Model&) = nullptr;
    /// The block of an object; block1 of a contact; no_row outside the rock.
    Row (*block)(const Model&, Row) = nullptr;
    /// The point that ranges test.
    Vec3 (*place)(const Model&, Row) = nullptr;
    /// Its number for users; null: none.
    std::int64_t (*number)(const Model&, Row) = nullptr;
    /// Hidden with its block, or with one of its blocks; null: never.
    bool (*shown)(const Model&, Row) = nullptr;
    /// The column of its groups; null: none.
    Column<std::int32_t>& (*groups)(Model&) = nullptr;

    // How it is found again. Objects counted within their block depend on the block's shape; other kinds have their own identities.
    Span (*in_block)(const Model&, Row block) = nullptr;
    Identity (*identity)(const Model&, Row) = nullptr;
    Row (*find)(const Model&, const Identity&) = nullptr; ///< no_row: deleted

    bool found_late = false; ///< contacts are searched on first use

    // Histories.
    std::int32_t history = -1; ///< its number in save files; -1: nothing of it can be recorded
    const char* missing = "";  ///< the noun of messages about missing ones
    const char* remedy = "";   ///< then

    // FISH. Names that begin with `classic` and `modern` follow from them: gp_near, block.gp.near.
    std::string_view classic = {}, modern = {}; ///< "" when FISH has none of these names
    bool has_properties = false;                ///< cx_prop, block.subcontact.prop
    bool has_spares = false;                    ///< cx_ispare, cx_rspare
};

const KindInfo& info_of(ObjectKind kind);
std::span<const KindInfo> kinds();
/// The kind of that history number; none when no kind has it.
ObjectKind recorded_kind(std::int32_t history);

/// From an object, or from the whole model, to others.
struct Relation {
    ObjectKind from = ObjectKind::none, to = ObjectKind::none;
    /// The list: FISH walks it from the first to the next ones.
    Span (*list)(const Model&, Row) = nullptr;
    /// The owner of the list that contains an object.
    Row (*owner)(const Model&, Row) = nullptr;
    /// Entries of the list that are skipped; null: none.
    bool (*skips)(const Model&, const Span& list, Row row) = nullptr;
    /// Without a list: some of them, by number...
    std::vector<Row> (*numbered)(const Model&, Row) = nullptr;
    /// ... or just one.
    Row (*one)(const Model&, Row) = nullptr;
    struct Names {
        std::string_view classic = {}, modern = {};
    };
    Names first{}; ///< of the list; without a list: the relation itself
    Names next{};
    std::string_view array = {}; ///< returns all of them at once
};
std::span<const Relation> relations();

/// How many objects of a kind there are.
inline std::size_t count_of(const Model& model, ObjectKind kind) { return info_of(kind).count(model); }
/// The point that is tested.
inline Vec3 reference_point(const Model& model, ObjectKind kind, Row row) { return info_of(kind).place(model, row); }
inline Row block_of(const Model& model, ObjectKind kind, Row row) { return info_of(kind).block(model, row); }

} // namespace kaya
