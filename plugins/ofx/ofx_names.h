// Strings of the OpenFX specification that our plug-in and ofx-check use (see ofx.h), by the page that
// describes them.
#pragma once

namespace ofx {

// --- "Suites Reference"
inline constexpr const char* kPropertySuite = "OfxPropertySuite";
inline constexpr const char* kImageEffectSuite = "OfxImageEffectSuite";
inline constexpr const char* kParameterSuite = "OfxParameterSuite";
inline constexpr const char* kMessageSuite = "OfxMessageSuite";
inline constexpr const char* kProgressSuite = "OfxProgressSuite";
inline constexpr const char* kMemorySuite = "OfxMemorySuite";
inline constexpr const char* kMultiThreadSuite = "OfxMultiThreadSuite";
inline constexpr const char* kInteractSuite = "OfxInteractSuite";
inline constexpr const char* kDrawSuite = "OfxDrawSuite";

// --- "Actions Passed to An Image Effect", and the actions of interacts
inline constexpr const char* kImageEffectApi = "OfxImageEffectPluginAPI";
namespace action {
inline constexpr const char* kLoad = "OfxActionLoad";
inline constexpr const char* kUnload = "OfxActionUnload";
inline constexpr const char* kDescribe = "OfxActionDescribe";
inline constexpr const char* kDescribeInContext = "OfxImageEffectActionDescribeInContext";
inline constexpr const char* kCreate = "OfxActionCreateInstance";
inline constexpr const char* kDestroy = "OfxActionDestroyInstance";
inline constexpr const char* kBeginChanged = "OfxActionBeginInstanceChanged";
inline constexpr const char* kChanged = "OfxActionInstanceChanged";
inline constexpr const char* kEndChanged = "OfxActionEndInstanceChanged";
inline constexpr const char* kPurgeCaches = "OfxActionPurgeCaches";
inline constexpr const char* kSync = "OfxActionSyncPrivateData";
inline constexpr const char* kRegionOfDefinition = "OfxImageEffectActionGetRegionOfDefinition";
inline constexpr const char* kRegionsOfInterest = "OfxImageEffectActionGetRegionsOfInterest";
inline constexpr const char* kClipPreferences = "OfxImageEffectActionGetClipPreferences";
inline constexpr const char* kIsIdentity = "OfxImageEffectActionIsIdentity";
inline constexpr const char* kBeginSequence = "OfxImageEffectActionBeginSequenceRender";
inline constexpr const char* kRender = "OfxImageEffectActionRender";
inline constexpr const char* kEndSequence = "OfxImageEffectActionEndSequenceRender";
inline constexpr const char* kDraw = "OfxInteractActionDraw";
inline constexpr const char* kPenDown = "OfxInteractActionPenDown";
inline constexpr const char* kPenMotion = "OfxInteractActionPenMotion";
inline constexpr const char* kPenUp = "OfxInteractActionPenUp";
}  // namespace action

// --- "Properties Reference": of any object
inline constexpr const char* kType = "OfxPropType";
inline constexpr const char* kName = "OfxPropName";
inline constexpr const char* kLabel = "OfxPropLabel";
inline constexpr const char* kTime = "OfxPropTime";
inline constexpr const char* kVersion = "OfxPropVersion";
inline constexpr const char* kVersionLabel = "OfxPropVersionLabel";
inline constexpr const char* kApiVersion = "OfxPropAPIVersion";
inline constexpr const char* kDescription = "OfxPropPluginDescription";
inline constexpr const char* kInstanceData = "OfxPropInstanceData";
inline constexpr const char* kChangeReason = "OfxPropChangeReason";
inline constexpr const char* kTypeParameter = "OfxTypeParameter";
inline constexpr const char* kUserEdited = "OfxChangeUserEdited";
inline constexpr const char* kIsInteractive = "OfxPropIsInteractive";
inline constexpr const char* kEffectInstance = "OfxPropEffectInstance";
inline constexpr const char* kFilePath = "OfxPluginPropFilePath";

// --- of effects and their instances
inline constexpr const char* kContext = "OfxImageEffectPropContext";
inline constexpr const char* kContexts = "OfxImageEffectPropSupportedContexts";
inline constexpr const char* kContextFilter = "OfxImageEffectContextFilter";
inline constexpr const char* kContextGeneral = "OfxImageEffectContextGeneral";
inline constexpr const char* kGrouping = "OfxImageEffectPluginPropGrouping";
inline constexpr const char* kPixelDepths = "OfxImageEffectPropSupportedPixelDepths";
inline constexpr const char* kComponentsSupported = "OfxImageEffectPropSupportedComponents";
inline constexpr const char* kTiles = "OfxImageEffectPropSupportsTiles";
inline constexpr const char* kMultiResolution = "OfxImageEffectPropSupportsMultiResolution";
inline constexpr const char* kTemporalAccess = "OfxImageEffectPropTemporalClipAccess";
inline constexpr const char* kThreadSafety = "OfxImageEffectPluginRenderThreadSafety";
inline constexpr const char* kFullySafe = "OfxImageEffectRenderFullySafe";
inline constexpr const char* kInstanceSafe = "OfxImageEffectRenderInstanceSafe";
inline constexpr const char* kUnsafe = "OfxImageEffectRenderUnsafe";
inline constexpr const char* kHostFrameThreading = "OfxImageEffectPluginPropHostFrameThreading";
inline constexpr const char* kSingleInstance = "OfxImageEffectPluginPropSingleInstance";
inline constexpr const char* kMultipleDepths = "OfxImageEffectPropMultipleClipDepths";
inline constexpr const char* kMultipleAspects = "OfxImageEffectPropSupportsMultipleClipPARs";
inline constexpr const char* kOverlays = "OfxImageEffectPropSupportsOverlays";
inline constexpr const char* kOverlayV1 = "OfxImageEffectPluginPropOverlayInteractV1";
inline constexpr const char* kOverlayV2 = "OfxImageEffectPluginPropOverlayInteractV2";
inline constexpr const char* kPreferencesFrom = "OfxImageEffectPropClipPreferencesSlaveParam";
inline constexpr const char* kPluginHandle = "OfxImageEffectPropPluginHandle";
inline constexpr const char* kProjectSize = "OfxImageEffectPropProjectSize";
inline constexpr const char* kProjectOffset = "OfxImageEffectPropProjectOffset";
inline constexpr const char* kProjectExtent = "OfxImageEffectPropProjectExtent";
inline constexpr const char* kProjectAspect = "OfxImageEffectPropPixelAspectRatio";
inline constexpr const char* kColourStyle = "OfxImageEffectPropColourManagementStyle";
inline constexpr const char* kColourCore = "OfxImageEffectColourManagementCore";
inline constexpr const char* kColourspacesFor = "OfxImageClipPropPreferredColourspaces_";
inline constexpr const char* kSceneLinear = "ofx_scene_linear";
inline constexpr const char* kRaw = "ofx_raw";

// --- of clips and images
inline constexpr const char* kOutput = "Output";
inline constexpr const char* kSource = "Source";
inline constexpr const char* kOptional = "OfxImageClipPropOptional";
inline constexpr const char* kIsMask = "OfxImageClipPropIsMask";
inline constexpr const char* kConnected = "OfxImageClipPropConnected";
inline constexpr const char* kPixelDepth = "OfxImageEffectPropPixelDepth";
inline constexpr const char* kComponents = "OfxImageEffectPropComponents";
inline constexpr const char* kPreMultiplication = "OfxImageEffectPropPreMultiplication";
inline constexpr const char* kOpaque = "OfxImageOpaque";
inline constexpr const char* kPreMultiplied = "OfxImageAlphaPremultiplied";
inline constexpr const char* kUnPreMultiplied = "OfxImageAlphaUnPremultiplied";
inline constexpr const char* kRgba = "OfxImageComponentRGBA";
inline constexpr const char* kRgb = "OfxImageComponentRGB";
inline constexpr const char* kAlpha = "OfxImageComponentAlpha";
inline constexpr const char* kComponentNone = "OfxImageComponentNone";
inline constexpr const char* kFloat = "OfxBitDepthFloat";
inline constexpr const char* kHalf = "OfxBitDepthHalf";
inline constexpr const char* kByte = "OfxBitDepthByte";
inline constexpr const char* kShort = "OfxBitDepthShort";
inline constexpr const char* kData = "OfxImagePropData";
inline constexpr const char* kBounds = "OfxImagePropBounds";
inline constexpr const char* kImageRegion = "OfxImagePropRegionOfDefinition";
inline constexpr const char* kRowBytes = "OfxImagePropRowBytes";
inline constexpr const char* kPixelAspect = "OfxImagePropPixelAspectRatio";
inline constexpr const char* kField = "OfxImagePropField";
inline constexpr const char* kFieldNone = "OfxFieldNone";
inline constexpr const char* kImageId = "OfxImagePropUniqueIdentifier";

// --- of the arguments of actions
inline constexpr const char* kRenderScale = "OfxImageEffectPropRenderScale";
inline constexpr const char* kRenderWindow = "OfxImageEffectPropRenderWindow";
inline constexpr const char* kFieldToRender = "OfxImageEffectPropFieldToRender";
inline constexpr const char* kSequential = "OfxImageEffectPropSequentialRenderStatus";
inline constexpr const char* kInteractive = "OfxImageEffectPropInteractiveRenderStatus";
inline constexpr const char* kDraft = "OfxImageEffectPropRenderQualityDraft";
inline constexpr const char* kThumbnail = "OfxImageEffectPropThumbnailRender";
inline constexpr const char* kNoSpatial = "OfxImageEffectPropNoSpatialAwareness";
inline constexpr const char* kFrameRange = "OfxImageEffectPropFrameRange";
inline constexpr const char* kFrameStep = "OfxImageEffectPropFrameStep";
inline constexpr const char* kDefinition = "OfxImageEffectPropRegionOfDefinition";
inline constexpr const char* kInterest = "OfxImageEffectPropRegionOfInterest";
inline constexpr const char* kInterestOf = "OfxImageClipPropRoI_";  // followed by the name of the clip
inline constexpr const char* kComponentsOf = "OfxImageClipPropComponents_";
inline constexpr const char* kDepthOf = "OfxImageClipPropDepth_";
inline constexpr const char* kAspectOf = "OfxImageClipPropPAR_";
inline constexpr const char* kPenPosition = "OfxInteractPropPenPosition";
inline constexpr const char* kPenPressure = "OfxInteractPropPenPressure";
inline constexpr const char* kPixelScale = "OfxInteractPropPixelScale";
inline constexpr const char* kDrawContext = "OfxInteractPropDrawContext";
inline constexpr const char* kSlaveTo = "OfxInteractPropSlaveToParam";

// --- of parameters
namespace param {
inline constexpr const char* kInteger = "OfxParamTypeInteger";
inline constexpr const char* kDouble = "OfxParamTypeDouble";
inline constexpr const char* kBoolean = "OfxParamTypeBoolean";
inline constexpr const char* kChoice = "OfxParamTypeChoice";
inline constexpr const char* kString = "OfxParamTypeString";
inline constexpr const char* kDouble2D = "OfxParamTypeDouble2D";
inline constexpr const char* kGroup = "OfxParamTypeGroup";
inline constexpr const char* kPage = "OfxParamTypePage";
inline constexpr const char* kPushButton = "OfxParamTypePushButton";
inline constexpr const char* kHint = "OfxParamPropHint";
inline constexpr const char* kParent = "OfxParamPropParent";
inline constexpr const char* kScriptName = "OfxParamPropScriptName";
inline constexpr const char* kDefault = "OfxParamPropDefault";
inline constexpr const char* kMin = "OfxParamPropMin";
inline constexpr const char* kMax = "OfxParamPropMax";
inline constexpr const char* kDisplayMin = "OfxParamPropDisplayMin";
inline constexpr const char* kDisplayMax = "OfxParamPropDisplayMax";
inline constexpr const char* kDigits = "OfxParamPropDigits";
inline constexpr const char* kAnimates = "OfxParamPropAnimates";
inline constexpr const char* kPersistent = "OfxParamPropPersistant";
inline constexpr const char* kEvaluates = "OfxParamPropEvaluateOnChange";
inline constexpr const char* kChoiceOption = "OfxParamPropChoiceOption";
inline constexpr const char* kStringMode = "OfxParamPropStringMode";
inline constexpr const char* kFilePath = "OfxParamStringIsFilePath";
inline constexpr const char* kFileExists = "OfxParamPropStringFilePathExists";
inline constexpr const char* kDoubleType = "OfxParamPropDoubleType";
inline constexpr const char* kXYAbsolute = "OfxParamDoubleTypeXYAbsolute";
inline constexpr const char* kCoordinates = "OfxParamPropDefaultCoordinateSystem";
inline constexpr const char* kNormalised = "OfxParamCoordinatesNormalised";
}  // namespace param

// --- "Message Suite"
inline constexpr const char* kMessageError = "OfxMessageError";
inline constexpr const char* kMessageWarning = "OfxMessageWarning";

// --- Types of objects: values of kType
inline constexpr const char* kTypeHost = "OfxTypeImageEffectHost";
inline constexpr const char* kTypeEffect = "OfxTypeImageEffect";
inline constexpr const char* kTypeInstance = "OfxTypeImageEffectInstance";
inline constexpr const char* kTypeClip = "OfxTypeClip";
inline constexpr const char* kTypeImage = "OfxTypeImage";

}  // namespace ofx
