// "contacts", "frets" and "neck" of a string -> one list of contacts, in that order.
#pragma once

#include <vector>

#include "formats/json/object_reader.h"
#include "formats/scene/scene.h"
#include "formats/scene/system.h"
#include "jawari/scene/description.h"

namespace jawari::host {

/// Motions of contacts go to `tables`.
std::vector<ContactDescription> read_all_contacts(json::ObjectReader& string, System& system, double length_m,
                                                  ContactSources& sources, DrivenTables& tables);

}  // namespace jawari::host
