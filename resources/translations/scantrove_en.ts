<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="en_GB" sourcelanguage="en">
<context>
    <name>NextSteps</name>
    <message numerus="yes">
        <source>Name %n found objects</source>
        <translation>
            <numerusform>Name %n found object</numerusform>
            <numerusform>Name %n found objects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Check %n key frames</source>
        <translation>
            <numerusform>Check %n key frame</numerusform>
            <numerusform>Check %n key frames</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>QObject</name>
    <message numerus="yes">
        <source>Merge %n classes</source>
        <translation>
            <numerusform>Merge %n class</numerusform>
            <numerusform>Merge %n classes</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Delete %n classes</source>
        <translation>
            <numerusform>Delete %n class</numerusform>
            <numerusform>Delete %n classes</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::CatalogueEditor</name>
    <message numerus="yes">
        <source>Confirm %n objects</source>
        <translation>
            <numerusform>Confirm %n object</numerusform>
            <numerusform>Confirm %n objects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Unconfirm %n objects</source>
        <translation>
            <numerusform>Unconfirm %n object</numerusform>
            <numerusform>Unconfirm %n objects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Delete %n objects</source>
        <translation>
            <numerusform>Delete %n object</numerusform>
            <numerusform>Delete %n objects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>Merge %n objects</source>
        <translation>
            <numerusform>Merge %n object</numerusform>
            <numerusform>Merge %n objects</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ClassDialog</name>
    <message numerus="yes">
        <source>%n classes written to %1.</source>
        <translation>
            <numerusform>%n class written to %1.</numerusform>
            <numerusform>%n classes written to %1.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ExportDialog</name>
    <message numerus="yes">
        <source>%n scans</source>
        <translation>
            <numerusform>%n scan</numerusform>
            <numerusform>%n scans</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n images</source>
        <translation>
            <numerusform>%n image</numerusform>
            <numerusform>%n images</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n objects</source>
        <translation>
            <numerusform>%n object</numerusform>
            <numerusform>%n objects</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n masks</source>
        <translation>
            <numerusform>%n mask</numerusform>
            <numerusform>%n masks</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>
%n frames are not included: %1</source>
        <translation>
            <numerusform>
%n frame is not included: %1</numerusform>
            <numerusform>
%n frames are not included: %1</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n scans of the project. Count shows what they hold.</source>
        <translation>
            <numerusform>%n scan of the project. Count shows what it holds.</numerusform>
            <numerusform>%n scans of the project. Count shows what they hold.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ExportSampleView</name>
    <message numerus="yes">
        <source>Frame %1 — %2 of %3 — %n masks</source>
        <translation>
            <numerusform>Frame %1 — %2 of %3 — %n mask</numerusform>
            <numerusform>Frame %1 — %2 of %3 — %n masks</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectListModel</name>
    <message numerus="yes">
        <source>%n views</source>
        <translation>
            <numerusform>%n view</numerusform>
            <numerusform>%n views</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ObjectPages</name>
    <message numerus="yes">
        <source>%n key frames</source>
        <translation>
            <numerusform>%n key frame</numerusform>
            <numerusform>%n key frames</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n regions</source>
        <translation>
            <numerusform>%n region</numerusform>
            <numerusform>%n regions</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>From %n views, because no scan with it is open.</source>
        <translation>
            <numerusform>From %n view, because no scan with it is open.</numerusform>
            <numerusform>From %n views, because no scan with it is open.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ProgressStrip</name>
    <message numerus="yes">
        <source>%1 of %n frames</source>
        <translation>
            <numerusform>%1 of %n frame</numerusform>
            <numerusform>%1 of %n frames</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1:%2   %n frames</source>
        <translation>
            <numerusform>%1:%2   %n frame</numerusform>
            <numerusform>%1:%2   %n frames</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ProposalBar</name>
    <message numerus="yes">
        <source>  and %n more</source>
        <translation>
            <numerusform>  and %n more</numerusform>
            <numerusform>  and %n more</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::RegionNaming</name>
    <message numerus="yes">
        <source>Name of %n regions</source>
        <translation>
            <numerusform>Name of %n region</numerusform>
            <numerusform>Name of %n regions</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::RegionOperations</name>
    <message numerus="yes">
        <source>%n regions</source>
        <translation>
            <numerusform>%n region</numerusform>
            <numerusform>%n regions</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::SavedScansPanel</name>
    <message numerus="yes">
        <source>%1 of %n objects named</source>
        <translation>
            <numerusform>%1 of %n object named</numerusform>
            <numerusform>%1 of %n objects named</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%n frames</source>
        <translation>
            <numerusform>%n frame</numerusform>
            <numerusform>%n frames</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%1 of %n images reviewed</source>
        <translation>
            <numerusform>%1 of %n image reviewed</numerusform>
            <numerusform>%1 of %n images reviewed</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>and %n more: File &gt; Open scan</source>
        <translation>
            <numerusform>and %n more: File &gt; Open scan</numerusform>
            <numerusform>and %n more: File &gt; Open scan</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::ServerDialog</name>
    <message numerus="yes">
        <source>The server answers. The catalogue holds %n objects.</source>
        <translation>
            <numerusform>The server answers. The catalogue holds %n object.</numerusform>
            <numerusform>The server answers. The catalogue holds %n objects.</numerusform>
        </translation>
    </message>
</context>
<context>
    <name>scantrove::StatusStrip</name>
    <message numerus="yes">
        <source>%Ln regions</source>
        <translation>
            <numerusform>%Ln region</numerusform>
            <numerusform>%Ln regions</numerusform>
        </translation>
    </message>
    <message numerus="yes">
        <source>%Ln bricks</source>
        <translation>
            <numerusform>%Ln brick</numerusform>
            <numerusform>%Ln bricks</numerusform>
        </translation>
    </message>
</context>
</TS>
