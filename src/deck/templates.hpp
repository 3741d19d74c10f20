#pragma once

#include "core/template.hpp"

namespace vibrotrough::deck {

/// The files of input_templates/, by name without ".mustache", as they were when the program was built.
extern core::TemplateTexts const input_templates;

}  // namespace vibrotrough::deck
