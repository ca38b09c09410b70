#include "plugin/core/preset_facts.h"

#include <variant>

#include "formats/json/parse.h"

namespace jawari::host {

std::optional<PresetFacts> preset_facts(std::string_view text, const std::string& file) {
    const auto document = json::parse(text, file);
    if (!document) return std::nullopt;
    const auto* object = std::get_if<json::Object>(&document.value().content);
    if (object == nullptr) return std::nullopt;
    const auto text_of = [&](const char* key) {
        const json::Value* const value = json::find(*object, key);
        const auto* words = value == nullptr ? nullptr : std::get_if<std::string>(&value->content);
        return words == nullptr ? std::string() : *words;
    };
    if (!text_of("schema").starts_with("jawari.preset/")) return std::nullopt;
    PresetFacts facts{text_of("name"), text_of("comment")};
    const json::Value* const comment = json::find(*object, "comment");
    const auto* lines = comment == nullptr ? nullptr : std::get_if<json::Array>(&comment->content);
    for (std::size_t i = 0; lines != nullptr && i < lines->size(); ++i)
        if (const auto* line = std::get_if<std::string>(&(*lines)[i].content))
            facts.comment += (facts.comment.empty() ? "" : "\n") + *line;
    return facts;
}

}  // namespace jawari::host
