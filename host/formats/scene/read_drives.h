// "forces" and "plucks" of a string, and "motion" of a contact.
#pragma once

#include "formats/json/object_reader.h"
#include "formats/scene/scene.h"
#include "formats/scene/system.h"

namespace jawari::host {

/// Appends to string.forces and tables.forces. The string's modes are known.
void read_forces(json::ObjectReader& reader, System& system, StringDescription& string, DrivenTables& tables);
void read_plucks(json::ObjectReader& reader, System& system, StringDescription& string, DrivenTables& tables);

/// "motion" of contact `index`, if it has one.
void read_motion(json::ObjectReader& contact, std::size_t index, DrivenTables& tables);

}  // namespace jawari::host
