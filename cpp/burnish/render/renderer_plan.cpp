// The part of Renderer that chooses what to draw: a plan, and its pipelines where they take time to compile.
#include "burnish/render/renderer.h"
#include "burnish/vulkan/device.h"

namespace burnish::render {

Plan Renderer::make_plan(const Scene& scene, const PlanSettings& settings) {
    PlanSettings for_device = settings;
    for_device.lookup = lookup_;
    if (device_->info().compiles_slowly)
        for_device.sample_source = SampleSource::one_by_one;
    else if (compilation_ == Compilation::shared && settings.sample_source == SampleSource::constants)
        for_device.sample_source = SampleSource::buffer;
    return burnish::make_plan(scene, for_device, suns_);
}

Renderer::ShadePlan Renderer::plan_shading(const Scene& scene, const PlanSettings& settings,
                                           ShadeTarget target) {
    Plan plan = make_plan(scene, settings);
    ShadeTables tables = make_shade_tables(device_, scene, plan, tables_, diffuse_);
    if (compilation_ != Compilation::background) return {std::move(plan), std::move(tables)};

    std::vector<ComputeKey> keys;
    for (uint32_t k = 0; k < plan.classes.size(); ++k)
        if (plan.classes[k].table == TableForm::constant) keys.push_back(shade_key(plan, tables, k, target));
    if (pipelines_.request(keys)) return {std::move(plan), std::move(tables)};

    PlanSettings meanwhile = settings;
    meanwhile.sample_source = SampleSource::meanwhile;
    plan = make_plan(scene, meanwhile);
    std::vector<vulkan::PassTime> made = std::move(tables.pass_times);
    tables = make_shade_tables(device_, scene, plan, tables_, diffuse_);
    tables.pass_times.insert(tables.pass_times.end(), made.begin(), made.end());
    return {std::move(plan), std::move(tables)};
}

void Renderer::finish_compiling() {
    device_->require_usable(); // a fork would wait for a thread that it does not have
    pipelines_.finish_compiling();
}

} // namespace burnish::render
