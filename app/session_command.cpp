#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/command.h"
#include "app/core_application.h"
#include "app/kernel_cache_use.h"
#include "app/number_check.h"
#include "app/session_edits.h"
#include "app/session_list_command.h"
#include "app/session_paint.h"
#include "app/session_readout.h"
#include "app/session_refine_command.h"
#include "app/session_review.h"
#include "app/session_suggest.h"
#include "core/base/text.h"

namespace scantrove {
namespace {

using SessionAction = std::function<Result<void>(OpenSession&, const SessionArguments&)>;

Result<void> runAction(const SessionArguments& arguments, const SessionAction& action) {
  const KernelCacheUse kernels;
  const CoreApplication qt;
  auto session = OpenSession::open(arguments.folder, arguments.device);
  if (!session) return fail(session.error());
  for (const std::string& damage : (*session)->damages())
    std::cerr << "scantrove: " << inLine(damage) << '\n';
  if (arguments.without_catalogue) (*session)->omitCatalogue();
  SCANTROVE_TRY(action(**session, arguments));
  return (*session)->findDisturbance();
}

/// `check` may throw CLI::ValidationError.
CLI::App* addAction(CLI::App& parent, const char* name, const char* help,
                    const std::shared_ptr<SessionArguments>& arguments, CommandJob& job, SessionAction action,
                    std::function<void(const SessionArguments&)> check = {}) {
  CLI::App* sub = parent.add_subcommand(name, help);
  sub->add_option("DIR", arguments->folder, "folder of the session")->required();
  sub->add_flag("--json", arguments->json, "as JSON");
  sub->add_option("--device", arguments->device, "OpenCL device; 'scantrove devices' lists them")
      ->type_name("INDEX|NAME");
  sub->callback([arguments, &job, action = std::move(action), check = std::move(check)] {
    if (check) check(*arguments);
    job = [arguments, action] { return runAction(*arguments, action); };
  });
  return sub;
}

SessionAction edit(OperationKind kind) {
  return [kind](OpenSession& session, const SessionArguments& arguments) {
    return editSession(session, arguments, kind);
  };
}

void addMaskOptions(CLI::App& suggest, SessionArguments& arguments) {
  suggest
      .add_option("--masks", arguments.masks,
                  "folder with masks of key frames: NNNNNN.png (16 bits, 0 = none), or one COCO file")
      ->required()
      ->type_name("FOLDER");
  suggest
      .add_option("--min-frames", arguments.min_frames, "frames that must agree on a proposal (default: 3)")
      ->transform(wholeNumber(1))
      ->type_name("N");
  suggest.add_flag("--apply", arguments.apply, "perform the proposals; each can be undone");
}

void addOff(CLI::App& sub, SessionArguments& arguments) {
  sub.add_flag("--off", arguments.undo, "undo the mark");
}

/// Takes numbers of regions, or --proposed.
void addBackground(CLI::App& parent, const std::shared_ptr<SessionArguments>& arguments, CommandJob& job) {
  const auto mark = [](OpenSession& session, const SessionArguments& given) {
    return given.proposed ? markProposedBackground(session, given)
                          : editSession(session, given, OperationKind::background);
  };
  const auto check = [](const SessionArguments& given) {
    if (given.regions.empty() != given.proposed)
      throw CLI::ValidationError("--proposed", "marks all proposed regions, R single ones. Give one of them");
    if (given.proposed && given.undo) throw CLI::ValidationError("--off", "needs numbers of regions");
  };
  CLI::App* sub =
      addAction(parent, "background", "Mark as background (wall, floor, table)", arguments, job, mark, check);
  sub->add_option("R", arguments->regions, "numbers of regions");
  sub->add_flag("--proposed", arguments->proposed,
                "instead of R: all regions that look like background, because things stand on them");
  addOff(*sub, *arguments);
}

void checkPaint(const SessionArguments& given) {
  if (given.paint_adds + given.paint_removes + given.paint_sets + given.new_region != 1)
    throw CLI::ValidationError("--add, --remove, --set",
                               "and --new-region exclude each other. Give one of them");
  if (given.mask_file.empty() == given.polygons.empty())
    throw CLI::ValidationError("MASK", "and --polygon say what is painted. Give one of them");
  if (given.new_region != given.regions.empty())
    throw CLI::ValidationError("--region", "is needed, except with --new-region");
  if (given.new_region && given.this_image_only)
    throw CLI::ValidationError("--this-image-only", "excludes --new-region");
  if (!given.new_region && (!given.name.empty() || given.category))
    throw CLI::ValidationError("--name, --class", "need --new-region; 'scantrove session name' names others");
}

Result<void> paintByArguments(OpenSession& session, const SessionArguments& arguments) {
  return arguments.new_region ? paintNewRegion(session, arguments) : paintRegion(session, arguments);
}

/// `add_frame`: adds the option --frame.
void addPaint(CLI::App& parent, const std::shared_ptr<SessionArguments>& arguments, CommandJob& job,
              const std::function<void(CLI::App&)>& add_frame) {
  const auto addRegion = [&](CLI::App& sub) {
    return sub.add_option("--region", arguments->regions, "number of the region")
        ->expected(1)
        ->allow_extra_args(false)
        ->type_name("R");
  };
  CLI::App* sub =
      addAction(parent, "paint", "Correct the mask of a region in one image, and the regions behind",
                arguments, job, paintByArguments, checkPaint);
  sub->add_option("MASK", arguments->mask_file,
                  "grey image of 8 bits with the size of the colour image: values above 127 are painted");
  add_frame(*sub);
  addRegion(*sub);
  sub->add_flag("--add", arguments->paint_adds, "painted pixels are the region");
  sub->add_flag("--remove", arguments->paint_removes, "painted pixels are not the region");
  sub->add_flag("--set", arguments->paint_sets, "painted pixels are the region, all others are not");
  sub->add_flag("--new-region", arguments->new_region,
                "instead of --region: what is painted becomes a region of its own");
  sub->add_option("--name", arguments->name, "name of the new region")->type_name("N");
  sub->add_option("--class,--category", arguments->category, "class of the new region")->type_name("C");
  sub->add_option("--polygon", arguments->polygons,
                  "instead of MASK: columns and rows of an outline; may be repeated, also for holes")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("x,y,...");
  sub->add_flag("--this-image-only", arguments->this_image_only, "leave regions and other images unchanged");
  sub->add_flag("--no-catalogue", arguments->without_catalogue, "change the session only, not its catalogue");
  CLI::App* unpaint = addAction(parent, "unpaint", "Take back what was painted for a region in one image",
                                arguments, job, unpaintRegion);
  add_frame(*unpaint);
  addRegion(*unpaint)->required();
  CLI::App* masks = addAction(parent, "masks", "Write the regions of one image as a PNG of 16 bits",
                              arguments, job, writeMasksOfImage);
  add_frame(*masks);
  masks->add_option("--out", arguments->out, "the new file")->required()->type_name("FILE");
}

void checkReview(const SessionArguments& given) {
  if (given.list != (given.review_frames.empty() && given.review_state.empty()))
    throw CLI::ValidationError("--list", "lists the states, --frame and --state set them. Give one of them");
  if (given.review_frames.empty() != given.review_state.empty())
    throw CLI::ValidationError("--frame", "and --state need each other");
}

void addReview(CLI::App& parent, const std::shared_ptr<SessionArguments>& arguments, CommandJob& job) {
  CLI::App* review = addAction(parent, "review", "Set or list the review states of key frames", arguments,
                               job, reviewKeyFrames, checkReview);
  review->add_option("--frame", arguments->review_frames, "frame number in the recording; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("N");
  review
      ->add_option("--state", arguments->review_state,
                   "checked: its labels are right; left-out: no data set has it; open: not checked yet")
      ->check(CLI::IsMember({"checked", "open", "left-out"}))
      ->type_name("checked|open|left-out");
  review->add_flag("--list", arguments->list, "list all key frames with their states");
}

}  // namespace

void addSessionCommand(CLI::App& app, CommandJob& job) {
  auto arguments = std::make_shared<SessionArguments>();
  CLI::App* parent = app.add_subcommand("session", "Show sessions and edit their regions");
  parent->require_subcommand(1);
  const auto add = [&](const char* name, const char* help, SessionAction action) {
    return addAction(*parent, name, help, arguments, job, std::move(action));
  };
  const auto addRegions = [&](CLI::App* sub) {
    sub->add_option("R", arguments->regions, "numbers of regions")->required();
    return sub;
  };
  const auto addRegion = [&](CLI::App* sub) {
    sub->add_option("--region", arguments->regions, "number of the region")
        ->required()
        ->expected(1)
        ->allow_extra_args(false)
        ->type_name("R");
    return sub;
  };
  const auto addNoCatalogue = [&](CLI::App* sub) {
    sub->add_flag("--no-catalogue", arguments->without_catalogue,
                  "change the session only, not its catalogue");
    return sub;
  };
  addSessionList(*parent, job);
  addSessionRefine(*parent, job);
  add("show", "Summary: frames, map, regions, operations", showSession);
  add("regions", "List all regions", listRegions);
  const auto addFrame = [&](CLI::App& sub) {
    sub.add_option("--frame", arguments->frame, "frame number in the recording")->required()->type_name("N");
  };
  CLI::App* at = add("at", "Show the region at a pixel of a frame", showAt);
  addFrame(*at);
  at->add_option("--pixel", arguments->pixel, "column and row in the depth image")
      ->required()
      ->type_name("x,y");
  CLI::App* name = addNoCatalogue(addRegion(
      add("name", "Name a region, which makes it an object of the catalogue", edit(OperationKind::name))));
  name->add_option("--name", arguments->name, "the name; empty removes it")->required()->type_name("N");
  name->add_option("--class,--category", arguments->category,
                   "its category, such as cup (default: unchanged)")
      ->type_name("C");
  addRegions(add("join", "Join regions; the first keeps its number", edit(OperationKind::join)));
  addBackground(*parent, arguments, job);
  addOff(*addNoCatalogue(addRegions(add("object", "Mark as object", edit(OperationKind::object)))),
         *arguments);
  addOff(*addRegions(add("reject", "Mark as not an object", edit(OperationKind::reject))), *arguments);
  addRegions(add("finer", "Split a region further", edit(OperationKind::finer)));
  addRegions(add("coarser", "Merge a region with its most likely neighbour", edit(OperationKind::coarser)));
  CLI::App* cut_command = add("cut", "Split a region between two sets of points, or around one", cutRegion);
  const auto addPoints = [&](const char* option, std::vector<std::string>& texts, const char* help) {
    return cut_command->add_option(option, texts, help)
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("N:x,y");
  };
  addPoints("--here", arguments->here, "frame, column and row of a point; may be repeated")->required();
  addPoints("--there", arguments->there,
            "a point of the other part; may be repeated (default: what surrounds --here in other colours)");
  addPaint(*parent, arguments, job, addFrame);
  addReview(*parent, arguments, job);
  const auto addSteps = [&](CLI::App* sub) {
    sub->add_option("--steps", arguments->steps, "number of operations")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
  };
  addSteps(addNoCatalogue(add("undo", "Undo the newest operation", undoEdits)));
  addSteps(addNoCatalogue(add("redo", "Redo the operation undone last", redoEdits)));
  add("history", "List all operations", listOperations);
  addMaskOptions(
      *addNoCatalogue(add("suggest", "Propose joins and cuts where masks of another program agree on them",
                          suggestFromMasks)),
      *arguments);
}

}  // namespace scantrove
