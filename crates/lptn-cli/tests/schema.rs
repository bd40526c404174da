//! `lptn schema`: JSON for editors, the same every time.

use crate::common::Folder;

#[test]
fn it_prints_one_json_object_the_same_every_time() {
    let folder = Folder::empty();
    let printed = folder.run(&["schema"]).exits(0).out.clone();
    let schema: serde_json::Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(schema, lptn_netlist::schema());
    assert_eq!(folder.run(&["schema"]).exits(0).out, printed);
    folder.run(&["schema", "--help"]).exits(0).prints("#:schema ./lptn.schema.json");
}
