//! Enums whose variants have words.

/// Declares an enum with one word for each variant, as files, options and results write it. The
/// word is next to its variant. `ALL` has the variants in their order.
///
/// ```
/// lptn_units::words! {
/// /// Which end is meant.
/// #[derive(Clone, Copy, Debug, PartialEq, Eq)]
/// pub enum End {
///     /// The cold one.
///     Cold = "cold",
///     /// The hot one.
///     Hot = "hot",
/// }
/// /// Its word in a file.
/// pub fn word;
/// }
///
/// assert_eq!(End::ALL.map(End::word), ["cold", "hot"]);
/// ```
#[macro_export]
macro_rules! words {
    (
        $(#[$meta:meta])*
        $vis:vis enum $Name:ident { $($(#[$doc:meta])* $Variant:ident = $word:literal,)* }
        $(#[$of_word:meta])*
        $reach:vis fn $method:ident;
    ) => {
        $(#[$meta])*
        $vis enum $Name { $($(#[$doc])* $Variant,)* }

        impl $Name {
            /// All of them, in their order.
            $vis const ALL: [Self; [$($word),*].len()] = [$(Self::$Variant),*];

            $(#[$of_word])*
            $reach const fn $method(self) -> &'static str {
                match self { $(Self::$Variant => $word,)* }
            }
        }
    };
}
