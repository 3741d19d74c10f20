#include "deck/render.hpp"

#include "deck/templates.hpp"

namespace vibrotrough::deck {

std::string render_template(std::string_view name, core::TemplateData const& data) {
    return core::parsed_template(input_templates, name).render(data);
}

}  // namespace vibrotrough::deck
